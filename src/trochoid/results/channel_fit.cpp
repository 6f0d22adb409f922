#include <trochoid/results/channel_fit.h>

#include <trochoid/base/rounded.h>
#include <trochoid/base/units.h>
#include <trochoid/results/columns.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>

namespace trochoid::results {

namespace {

using identification::ChannelReport;
using identification::Fit;
using identification::KnownSum;

const ChannelReport& report_of(const Fit& fit) {
  return *fit.channels;
}

/// Names of the case and units of the coefficients.
std::vector<force::Quantity> names_of(const Fit& fit) {
  return force::coefficient_quantities(fit.law);
}

/// The first coefficient of a sum, whose weight is 1.
std::size_t first_of(const KnownSum& sum) {
  std::size_t q = 0;
  while (q + 1 < sum.weights.size() && sum.weights[q] == 0.0) ++q;
  return q;
}

/// Weight of a coefficient where all are in the units of their keys.
double weight_as_named(const Fit& fit, const KnownSum& sum, std::size_t q) {
  const auto names = names_of(fit);
  return sum.weights[q] * names[q].unit / names[first_of(sum)].unit;
}

Array sums_value(const Fit& fit) {
  const auto names = names_of(fit);
  Array out;
  for (const KnownSum& sum : report_of(fit).combinations) {
    Object weights;
    for (std::size_t q = 0; q < sum.weights.size(); ++q) {
      if (sum.weights[q] == 0.0) continue;
      set(weights, names[q].key, weight_as_named(fit, sum, q));
    }
    const double unit = names[first_of(sum)].unit;
    out.push_back(Object{{"weights", std::move(weights)},
                         {"value", sum.value / unit},
                         {"se", sum.se / unit}});
  }
  return out;
}

Object prior_value(const Fit& fit) {
  const auto names = names_of(fit);
  const auto& prior = report_of(fit).prior;
  Object out;
  for (std::size_t q = 0; q < prior.size(); ++q) {
    if (!prior[q]) continue;
    set(out, names[q].key,
        Value(Object{{"mean", prior[q]->mean / names[q].unit},
                     {"sd", prior[q]->sd / names[q].unit}}));
  }
  return out;
}

Object data_alone_value(const Fit& fit) {
  const auto names = names_of(fit);
  const auto& alone = report_of(fit).data_alone;
  Object out;
  for (std::size_t q = 0; q < alone.size(); ++q) {
    set(out, names[q].key, estimate_value(alone[q], names[q].unit));
  }
  return out;
}

Value sensor_error(const Fit& fit) {
  const auto& se = report_of(fit).sensor_se;
  return se ? Value(*se / unit::deg) : Value();
}

/// One channel of a fit.
struct OneChannel {
  const FitOfChannels& of;
  std::size_t channel;
};

const Fields<OneChannel>& one_channel_fields() {
  static const Fields<OneChannel> all{
      {"axis", "what it reads, as in `[dynamometer] axes`",
       [](const OneChannel& c) {
         return channel_names(c.of.sensor.sensor)[c.channel];
       }},
      {"unit", "of `rms` and `sd`: `N`, `Nm` or `W`",
       [](const OneChannel& c) {
         return force::name_of(
             force::unit_of(c.of.sensor.sensor.channels[c.channel].axis));
       }},
      {"rms", "residual of the answer",
       [](const OneChannel& c) {
         return as_named(report_of(c.of.fit).rms[c.channel]);
       }},
      {"sd", "of one value, as it was weighted", [](const OneChannel& c) {
         return as_named(report_of(c.of.fit).sd[c.channel]);
       }}};
  return all;
}

/// Rows of channels.csv.
struct ChannelRow {
  std::size_t run = 0;
  std::size_t at = 0;
};

ChannelRow row_of(const FitOfChannels& of, std::size_t i) {
  ChannelRow row;
  const std::size_t channels = of.sensor.sensor.channels.size();
  for (const identification::ChannelData& data : of.sensor.data) {
    const std::size_t rows = data.value.size() / channels;
    if (i < rows) break;
    i -= rows;
    ++row.run;
  }
  row.at = i;
  return row;
}

std::size_t rows_of(const FitOfChannels& of) {
  std::size_t rows = 0;
  for (const auto& data : of.sensor.data) {
    rows += data.value.size() / of.sensor.sensor.channels.size();
  }
  return rows;
}

/// `1_measured`, `1_fitted`, `3_measured` ...
std::vector<std::string> measured_and_fitted(const FitOfChannels& of,
                                             force::ChannelUnit unit) {
  std::vector<std::string> names;
  for (const std::string& number : channels_of_unit(of.sensor.sensor, unit)) {
    names.push_back(number + "_measured");
    names.push_back(number + "_fitted");
  }
  return names;
}

Column<FitOfChannels> channel_column(std::string_view name, std::string_view meaning,
                                     force::ChannelUnit unit) {
  return {name, meaning,
          [unit](const FitOfChannels& of) { return measured_and_fitted(of, unit); },
          [unit](const FitOfChannels& of, std::size_t i, std::size_t k) {
            const auto& sensor = of.sensor.sensor;
            const ChannelRow row = row_of(of, i);
            const std::size_t at =
                row.at * sensor.channels.size() + channel_at(sensor, unit, k / 2);
            return k % 2 == 0 ? of.sensor.data[row.run].value[at]
                              : report_of(of.fit).fitted[row.run][at];
          }};
}

}  // namespace

std::vector<std::string> channel_names(const force::Sensor& sensor) {
  std::vector<std::string> out;
  for (const force::Channel& one : sensor.channels) {
    out.push_back(
        fmt::format("{}{}", one.sign < 0 ? "-" : "", force::name_of(one.axis)));
  }
  return out;
}

Value channel_names_value(const force::Sensor& sensor) {
  Array names;
  for (std::string& name : channel_names(sensor)) names.emplace_back(std::move(name));
  return names;
}

std::vector<std::string> channels_of_unit(const force::Sensor& sensor,
                                          force::ChannelUnit unit) {
  std::vector<std::string> out;
  for (std::size_t c = 0; c < sensor.channels.size(); ++c) {
    if (force::unit_of(sensor.channels[c].axis) == unit) {
      out.push_back(std::to_string(c + 1));
    }
  }
  return out;
}

std::size_t channel_at(const force::Sensor& sensor, force::ChannelUnit unit,
                       std::size_t k) {
  std::size_t c = 0;
  while (true) {
    if (force::unit_of(sensor.channels[c].axis) == unit && k-- == 0) return c;
    ++c;
  }
}

const Fields<FitOfChannels>& channel_fit_fields() {
  using Of = const FitOfChannels&;
  const auto with_prior = [](Of of) { return !report_of(of.fit).prior.empty(); };
  static const Fields<FitOfChannels> all{
      Field<FitOfChannels>{
          "combination",
          "where coefficients are not told: sums of weights times coefficients that are",
          [](Of of) { return as_named(sums_value(of.fit)); }}
          .with({{"[].weights", "by the key of the coefficient; the first is 1"},
                 {"[].weights.K_*", "weight of this coefficient, both in their units"},
                 {"[].value", "of the sum, in the unit of the first coefficient"},
                 {"[].se", "one standard error"}}),
      Field<FitOfChannels>{"prior", "what was known beforehand, as in `[prior]`",
                           [](Of of) { return as_named(prior_value(of.fit)); },
                           with_prior}
          .with({{".K_*", "of this coefficient"},
                 {".K_*.mean", "in the unit of its key"},
                 {".K_*.sd", "its standard deviation"}}),
      Field<FitOfChannels>{
          "data_alone",
          "the coefficients without the prior; `null` where the data do not tell them",
          [](Of of) { return as_named(data_alone_value(of.fit)); }, with_prior}
          .with(below_estimate(".*.")),
      {"sensor_deg", "angle of u from the tip of tooth 1 towards tooth 2",
       [](Of of) { return Content(Value(report_of(of.fit).sensor_angle)); }},
      {"sensor_se_deg", "its standard error; `null` where it was given",
       [](Of of) { return as_named(sensor_error(of.fit)); }},
      {"rank_with_prior", "rank with the rows of the prior",
       [](Of of) { return report_of(of.fit).rank_with_prior; }},
      {"weighted_rss", "sum of (residual/sd)^2, of the data without the prior",
       [](Of of) { return as_named(report_of(of.fit).weighted_rss); }},
      {"variance_factor",
       "by which variances are larger than the stated ones: 1 where those are known, else "
       "weighted_rss/(data less unknowns)",
       [](Of of) { return as_named(report_of(of.fit).variance_factor); }},
      {"channels", "each of them", one_channel_fields(), [](Of of) {
         std::vector<OneChannel> list;
         for (std::size_t c = 0; c < of.sensor.sensor.channels.size(); ++c) {
           list.push_back({of, c});
         }
         return list;
       }}};
  return all;
}

const Columns<FitOfChannels>& channel_columns_of_fit() {
  using Of = const FitOfChannels&;
  static const Columns<FitOfChannels> all{
      "channels.csv",
      rows_of,
      {{"run", "number of the measurement, from 1",
        [](Of of, std::size_t i) { return row_of(of, i).run + 1; }},
       {"angle_deg", "recorded angle; empty of a mean",
        [](Of of, std::size_t i) {
          const ChannelRow row = row_of(of, i);
          const auto& angle = of.sensor.data[row.run].angle;
          return angle.empty() ? std::numeric_limits<double>::quiet_NaN()
                               : angle[row.at];
        }},
       channel_column("channel*_N",
                      "`channel1_measured_N`, `channel1_fitted_N`, ...: of each force",
                      force::ChannelUnit::newton),
       channel_column("channel*_Nm", "the same of torque and moments",
                      force::ChannelUnit::newton_metre),
       channel_column("channel*_W", "the same of power", force::ChannelUnit::watt)}};
  return all;
}

std::vector<std::string> sums_in_words(const Fit& fit) {
  const auto names = names_of(fit);
  std::vector<std::string> out;
  for (const KnownSum& sum : report_of(fit).combinations) {
    std::string text;
    for (std::size_t q = 0; q < sum.weights.size(); ++q) {
      if (sum.weights[q] == 0.0) continue;
      const double w = weight_as_named(fit, sum, q);
      const std::string name(names[q].key.substr(0, names[q].key.find('_', 2)));
      text += text.empty()
                  ? name
                  : fmt::format(" {} {:.4g} {}", w < 0 ? '-' : '+', std::abs(w), name);
    }
    const auto& first = names[first_of(sum)];
    out.push_back(
        fmt::format("{} = {} {}", text,
                    base::with_error(sum.value / first.unit,
                                     fit.interval_factor * sum.se / first.unit),
                    first.key.ends_with("_MPa") ? "MPa" : "N/mm"));
  }
  return out;
}

std::string channel_lines(const FitOfChannels& of) {
  std::string text;
  for (const std::string& sum : sums_in_words(of.fit)) {
    text += fmt::format("known together: {} (95 %)\n", sum);
  }
  const ChannelReport& report = report_of(of.fit);
  const auto names = channel_names(of.sensor.sensor);
  for (std::size_t c = 0; c < names.size(); ++c) {
    text += fmt::format(
        "channel {}, {}: residual {:.3g} {} (rms)\n", c + 1, names[c], report.rms[c],
        force::name_of(force::unit_of(of.sensor.sensor.channels[c].axis)));
  }
  if (report.sensor_se) {
    text += fmt::format(
        "sensor_deg: {}\n",
        base::with_error(report.sensor_angle / unit::deg,
                         of.fit.interval_factor * *report.sensor_se / unit::deg));
  }
  if (!report.prior.empty()) {
    const auto keys = names_of(of.fit);
    for (std::size_t q = 0; q < report.prior.size(); ++q) {
      if (!report.prior[q]) continue;
      const auto& alone = report.data_alone[q];
      text += fmt::format(
          "{}: prior {:.4g}, sd {:.4g}; the data alone {}\n", keys[q].key,
          report.prior[q]->mean / keys[q].unit, report.prior[q]->sd / keys[q].unit,
          alone ? base::with_error(alone->value / keys[q].unit,
                                   0.5 * (alone->high - alone->low) / keys[q].unit)
                : std::string("tell nothing"));
    }
  }
  return text;
}

}  // namespace trochoid::results
