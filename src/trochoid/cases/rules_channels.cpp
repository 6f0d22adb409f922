#include <trochoid/cases/number_text.h>
#include <trochoid/cases/rules.h>

#include <fmt/core.h>

#include <algorithm>
#include <set>

namespace trochoid::cases {

namespace {

using force::Channel;

/// Forces in x, y and z, perhaps not all of them.
bool are_table_forces(const std::vector<Channel>& channels) {
  return std::ranges::all_of(
      channels, [](const Channel& one) { return one.axis <= force::ChannelAxis::z; });
}

std::string axes_text(const std::vector<Channel>& channels) {
  std::string out;
  for (const Channel& one : channels) {
    out += fmt::format("{}{}", out.empty() ? "" : ", ", force::name_of(one.axis));
  }
  return out;
}

bool any_mean(const Case& c) {
  return std::ranges::any_of(c.measurements,
                             [](const Measurement& m) { return !m.mean.empty(); });
}

/// Power or torque, and nothing else that is given.
bool is_one_of_the_spindle(const Case& c) {
  if (!c.dynamometer) return false;
  const auto& channels = c.dynamometer->sensor.channels;
  return channels.size() == 1 && !any_mean(c) && c.identify.prior.empty() &&
         c.dynamometer->channel_sd.empty() &&
         (channels.front().axis == force::ChannelAxis::power ||
          channels.front().axis == force::ChannelAxis::torque);
}

/// One number for each channel.
void check_count(const std::string& key, std::size_t count, std::size_t channels,
                 Findings& findings) {
  if (count == 0 || count == channels) return;
  report(findings, key,
         fmt::format("{}: {} entries for {} channel{}; must be one for each", key,
                     count, channels, channels == 1 ? "" : "s"));
}

/// What is said of the record of a measurement that has none.
void check_mean(const MeasurementTable& table, const std::string& path,
                Findings& findings) {
  const files::RecordSource& source = table.source;
  for (const auto& [key, there] :
       {std::pair{"columns", !source.columns.empty()},
        std::pair{"scale", !source.scale.empty()},
        std::pair{"angle_column", !source.angle_column.empty()},
        std::pair{"time_column", !source.time_column.empty()},
        std::pair{"pulse_column", !source.pulse_column.empty()},
        std::pair{"sample_rate_Hz", source.sample_rate.has_value()},
        std::pair{"from_s", table.from.has_value()},
        std::pair{"to_s", table.to.has_value()}}) {
    if (!there) continue;
    report(findings, path + "." + key,
           fmt::format("{}.{}: this describes a record, and a mean has none; must be "
                       "left out, or file in place of mean",
                       path, key));
  }
}

void check_measurements(const CaseTables& tables, std::size_t channels,
                        Findings& findings, Case& c) {
  for (std::size_t i = 0; i < c.measurements.size(); ++i) {
    const std::string path = fmt::format("measurement[{}]", i + 1);
    const MeasurementTable& table = tables.measurements[i];
    Measurement& m = c.measurements[i];
    if (!m.mean.empty()) {
      check_mean(table, path, findings);
      if (!table.source.file.name.empty()) {
        report(findings, path + ".mean",
               path + ".mean: file is given as well; must be one of the two");
      }
    } else if (!m.mean_sd.empty()) {
      report(findings, path + ".mean_sd",
             path + ".mean_sd: no mean is given; must go with mean");
    }
    check_count(path + ".mean", m.mean.size(), channels, findings);
    check_count(path + ".mean_sd", m.mean_sd.size(), channels, findings);
    check_count(path + ".scale", m.source.scale.size(), channels, findings);
    if (m.source.columns.size() > channels) {
      check_count(path + ".columns", m.source.columns.size(), channels, findings);
    }
    if (!m.source.columns.empty()) m.source.columns.resize(channels);
    // Three forces are found by the names of the channels, wherever these point.
    if (!c.dynamometer ||
        (channels == 3 && are_table_forces(c.dynamometer->sensor.channels))) {
      continue;
    }
    for (const Channel& one : c.dynamometer->sensor.channels) {
      m.source.axes.push_back(one.axis);
    }
  }
}

/// The coefficients of the law, in its order.
void settle_prior(const PriorTable& table, Findings& findings, Case& c) {
  std::set<std::string_view> known;
  for (const force::Quantity& quantity : force::coefficient_quantities(c.law)) {
    known.insert(quantity.key);
    const auto at = table.numbers.find(quantity.key);
    c.identify.prior.push_back(at == table.numbers.end() ? std::nullopt : at->second);
  }
  for (const auto& [key, value] : table.numbers) {
    if (!value || known.contains(key)) continue;
    report(
        findings, fmt::format("prior.{}", key),
        fmt::format("prior.{}: the law \"{}\" has no such coefficient; must be one of "
                    "its own",
                    key, force::name_of(c.law)));
  }
  if (std::ranges::none_of(c.identify.prior,
                           [](const auto& one) { return one.has_value(); })) {
    c.identify.prior.clear();
  }
}

/// Sections whose moments are read need a height.
void settle_gauge(Findings& findings, Case& c) {
  force::Sensor& sensor = c.dynamometer->sensor;
  sensor.gauge_length = c.gauge_length.value_or(0.0);
  for (std::size_t i = 0; i < sensor.channels.size() && !c.gauge_length; ++i) {
    const force::ChannelAxis axis = sensor.channels[i].axis;
    if (!force::needs_gauge_length(axis)) continue;
    report(findings, "dynamometer.axes",
           fmt::format(
               "dynamometer.axes entry {} = \"{}\": the height of the section whose "
               "moment is read is not known; must go with gauge_length_mm in [tool]",
               i + 1, force::name_of(axis)));
    return;
  }
}

/// Newtons and newton metres are never added as they are.
void check_weights(Findings& findings, const Case& c) {
  const auto& channels = c.dynamometer->sensor.channels;
  const bool one_unit = std::ranges::all_of(channels, [&](const Channel& one) {
    return force::unit_of(one.axis) == force::unit_of(channels.front().axis);
  });
  const bool weighted = !c.dynamometer->channel_sd.empty() ||
                        std::ranges::all_of(c.measurements, [](const Measurement& m) {
                          return !m.mean_sd.empty();
                        });
  if (one_unit || weighted || c.measurements.empty()) return;
  report(findings, "dynamometer.axes",
         fmt::format(
             "dynamometer.axes: channels of different units ({}) cannot be weighted "
             "against each other; must go with channel_sd",
             axes_text(channels)));
}

/// What a fit of the channels as they are does not know.
void refuse_for_channels(const CaseTables& tables, Findings& findings, const Case& c) {
  const auto refuse = [&](const std::string& key) {
    report(findings, key,
           fmt::format(
               "{}: not with channels other than forces x, y, z, nor with "
               "channel_sd, mean, [prior], axial offsets or tilt; must be left out",
               key));
  };
  if (tables.dynamometer && !tables.dynamometer->matrix.empty())
    refuse("dynamometer.matrix");
  if (c.dynamometer && c.dynamometer->automatic) {
    report(
        findings, "dynamometer.axes",
        "dynamometer.axes = \"auto\": found from records of three forces alone, without "
        "channel_sd, mean, [prior], axial offsets or tilt; must name what each channel "
        "reads");
  }
  if (c.dynamometer && !c.dynamometer->frf.name.empty()) refuse("dynamometer.frf");
  if (c.identify.band_harmonics.value_or(0) != 0) refuse("identify.band_harmonics");
  if (c.identify.sweep) refuse("identify.sweep_um");
  for (std::size_t i = 0; i < c.measurements.size(); ++i) {
    if (!c.measurements[i].group.empty())
      refuse(fmt::format("measurement[{}].group", i + 1));
  }
}

/// Without a frame that turns with the tool means tell no runout.
void settle_runout_of_means(Findings& findings, Case& c) {
  const bool means_only = std::ranges::all_of(
      c.measurements, [](const Measurement& m) { return !m.mean.empty(); });
  const bool turning =
      c.dynamometer &&
      std::ranges::any_of(c.dynamometer->sensor.channels, [](const Channel& one) {
        return force::turns_with_tool(one.axis);
      });
  if (!means_only || turning) return;
  using identification::RunoutUnknowns;
  const bool asked = c.identify.axial_offsets || c.identify.tilt ||
                     (c.identify.runout && *c.identify.runout != RunoutUnknowns::none &&
                      *c.identify.runout != RunoutUnknowns::fixed);
  if (asked) {
    report(findings, "identify.runout",
           "identify.runout: means of channels that do not turn with the tool tell no "
           "runout; must be \"none\" or \"fixed\"");
  }
  if (!c.identify.runout) c.identify.runout = RunoutUnknowns::fixed;
}

}  // namespace

void settle_channels(const CaseTables& tables, Command purpose, Findings& findings,
                     Case& c) {
  if (!sound(findings, {"dynamometer.axes", "dynamometer.matrix", "identify.runout"})) {
    return;
  }
  if (tables.prior) settle_prior(*tables.prior, findings, c);
  const bool named = c.dynamometer && !c.dynamometer->sensor.channels.empty();
  const bool table = !named || are_table_forces(c.dynamometer->sensor.channels);
  const std::size_t channels = named ? c.dynamometer->sensor.channels.size() : 3;
  check_measurements(tables, channels, findings, c);
  if (c.dynamometer) {
    check_count("dynamometer.channel_sd", c.dynamometer->channel_sd.size(), channels,
                findings);
    settle_gauge(findings, c);
  }
  c.identify.by_channels = !table || any_mean(c) || !c.identify.prior.empty() ||
                           c.identify.axial_offsets || c.identify.tilt ||
                           (c.dynamometer && !c.dynamometer->channel_sd.empty());
  if (!c.identify.by_channels) return;
  const bool means_only = std::ranges::all_of(
      c.measurements, [](const Measurement& m) { return !m.mean.empty(); });
  const bool plans_means = purpose == Command::plan && means_only;
  const bool of_program = purpose == Command::program && is_one_of_the_spindle(c);
  if (purpose != Command::identify && purpose != Command::simulate && !plans_means &&
      !of_program && !c.measurements.empty()) {
    report(findings, "dynamometer.axes",
           fmt::format(
               "dynamometer.axes: {} takes records of the forces x, y and z only{}, "
               "without channel_sd{} or [prior]; identify takes any channels, "
               "and its material.toml can be included",
               name_of(purpose),
               purpose == Command::program ? ", or of power or torque alone" : "",
               purpose == Command::plan ? "" : ", mean"));
  }
  if (purpose != Command::identify && !plans_means) return;
  if (!named && !(c.dynamometer && c.dynamometer->automatic)) {
    if (!c.dynamometer) c.dynamometer.emplace();
    c.dynamometer->sensor.channels = {
        {force::ChannelAxis::x}, {force::ChannelAxis::y}, {force::ChannelAxis::z}};
  }
  check_weights(findings, c);
  refuse_for_channels(tables, findings, c);
  settle_runout_of_means(findings, c);
}

}  // namespace trochoid::cases
