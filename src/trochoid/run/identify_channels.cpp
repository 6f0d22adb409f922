#include <trochoid/run/identify.h>

#include <trochoid/base/error.h>
#include <trochoid/base/rounded.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/channel_fit.h>
#include <trochoid/identification/fits.h>
#include <trochoid/identification/reliability.h>
#include <trochoid/results/channel_fit.h>
#include <trochoid/run/commands.h>
#include <trochoid/run/records.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

using identification::ChannelData;
using identification::Fit;
using results::IdentifyResult;

/// A part of the channels (rms) that is worth a word, where nothing says how exact they are.
constexpr double much_unexplained = 0.2;

bool is_mean(const cases::Measurement& m) {
  return !m.mean.empty();
}

/// The records among the measurements, read and laid over the angle.
std::vector<MeasuredRun> records_of(const cases::Case& given,
                                    std::vector<base::Warning>& warnings) {
  cases::Case records = given;
  std::erase_if(records.measurements, is_mean);
  if (records.measurements.empty()) return {};
  return measured_runs(records, warnings);
}

/// @throws base::InputError where a channel was not measured
ChannelData data_of(const MeasuredRun& run, std::size_t channels) {
  ChannelData data{.cut = run.run.cut, .angle = run.run.angle, .value = {}, .sd = {}};
  data.cut.Omega = run.Omega;
  std::vector<const std::vector<double>*> columns;
  for (std::size_t c = 0; c < channels; ++c) {
    const bool there = c >= 3 ? !run.further[c - 3].empty() : run.run.measured[c];
    if (!there) {
      throw base::InputError({fmt::format(
          "{}: channel {} was not measured; axes must name the channels that were",
          run.file, c + 1)});
    }
    columns.push_back(c < 3 ? &run.run.channel[c] : &run.further[c - 3]);
    const auto& further_se = run.further_offset_se;
    data.offset_se.push_back(c < 3                ? run.run.offset_se[c]
                             : further_se.empty() ? 0.0
                                                  : further_se[c - 3]);
  }
  data.value.reserve(data.angle.size() * channels);
  for (std::size_t i = 0; i < data.angle.size(); ++i) {
    for (const auto* column : columns) data.value.push_back((*column)[i]);
  }
  return data;
}

/// Root mean square of the means of a channel, its weight where nothing else is said.
double rms_of_means(const cases::Case& given, std::size_t channel) {
  double squares = 0.0;
  double count = 0.0;
  for (const cases::Measurement& m : given.measurements) {
    if (!is_mean(m)) continue;
    squares += m.mean[channel] * m.mean[channel];
    count += 1.0;
  }
  return squares > 0.0 ? std::sqrt(squares / count) : 1.0;
}

/// Standard deviations of one value of each channel, or weights that stand for them.
std::vector<double> deviations_of(const cases::Case& given,
                                  const cases::Measurement& m) {
  if (!m.mean_sd.empty()) return m.mean_sd;
  const auto& stated = given.dynamometer->channel_sd;
  if (!stated.empty()) return stated;
  std::vector<double> out(given.dynamometer->sensor.channels.size(), 1.0);
  for (std::size_t c = 0; c < out.size() && is_mean(m); ++c) {
    out[c] = rms_of_means(given, c);
  }
  return out;
}

/// All measurements in their order.
std::vector<ChannelData> all_data(const cases::Case& given,
                                  const std::vector<MeasuredRun>& records) {
  const std::size_t channels = given.dynamometer->sensor.channels.size();
  std::vector<ChannelData> out;
  std::size_t next = 0;
  for (const cases::Measurement& m : given.measurements) {
    out.push_back(
        is_mean(m) ? ChannelData{.cut = m.cut, .angle = {}, .value = m.mean, .sd = {}}
                   : data_of(records[next++], channels));
    out.back().sd = deviations_of(given, m);
  }
  return out;
}

/// Whether the standard deviations are those of the values, and not only weights.
bool deviations_known(const cases::Case& given) {
  return std::ranges::all_of(given.measurements, [&](const cases::Measurement& m) {
    return is_mean(m) ? !m.mean_sd.empty() : !given.dynamometer->channel_sd.empty();
  });
}

/// Whether the case says anything of how exact the channels are.
bool deviations_stated(const cases::Case& given) {
  return !given.dynamometer->channel_sd.empty() ||
         std::ranges::any_of(given.measurements, [](const cases::Measurement& m) {
           return !m.mean_sd.empty();
         });
}

/// Of the rms of a channel, where neither the case nor an equation tells its error.
constexpr double assumed_error = 0.01;

bool wants_offsets(const cases::Case& given, const std::vector<MeasuredRun>& records) {
  using cases::ChannelOffset;
  const ChannelOffset how = given.identify.channel_offsets;
  return how == ChannelOffset::fit ||
         (how == ChannelOffset::automatic &&
          std::ranges::any_of(records, has_offsets_to_find));
}

identification::ChannelRequest request_of(const cases::Case& given, chip::Model model,
                                          const std::vector<MeasuredRun>& records) {
  const cases::Identify& asked = given.identify;
  return {
      .chip_model = model,
      .runout = asked.runout.value_or(identification::RunoutUnknowns::offsets),
      .axial_offsets = asked.axial_offsets,
      .tilt = asked.tilt,
      .phase = asked.phase,
      .sensor_free = given.dynamometer->sensor_free,
      .fit_channel_offsets = wants_offsets(given, records),
      .absolute = deviations_known(given),
      .untold_variance = deviations_stated(given) ? 1.0 : assumed_error * assumed_error,
      .prior = asked.prior};
}

/// How much neighbouring residuals of the records agree, -1 to 1; of means: 0.
double correlation_of(const Fit& fit, const std::vector<ChannelData>& data,
                      std::size_t channels) {
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t b = 0; b < data.size(); ++b) {
    if (data[b].angle.empty()) continue;
    const auto left = [&](std::size_t i) {
      const double d = data[b].value[i] - fit.channels->fitted[b][i];
      return d / data[b].sd[i % channels];
    };
    for (std::size_t i = channels; i < data[b].value.size(); ++i) {
      products += left(i) * left(i - channels);
      squares += left(i) * left(i);
    }
  }
  return squares > 0.0 ? products / squares : 0.0;
}

/// The same fit with errors that count how far neighbouring residuals agree (I-8), where
/// nothing says how exact the channels are.
Fit fit_of(const cases::Case& given, const results::SensorOfFit& sensor,
           identification::ChannelRequest request) {
  const auto fitted = [&] {
    return identification::fit_channels(given.setup, given.law, sensor.sensor,
                                        sensor.data, request);
  };
  Fit fit = fitted();
  const bool white = given.identify.errors == identification::Errors::white;
  fit.residual_correlation =
      correlation_of(fit, sensor.data, sensor.sensor.channels.size());
  if (request.absolute || white ||
      fit.residual_correlation <= identification::noise_correlation) {
    return fit;
  }
  request.widening = identification::correlation_factor(fit.residual_correlation);
  const double correlation = fit.residual_correlation;
  fit = fitted();
  fit.residual_correlation = correlation;
  return fit;
}

/// What leaves more than the standard deviations say.
void warn_residual(const cases::Case& given, const Fit& fit,
                   std::vector<base::Warning>& warnings) {
  const bool absolute = deviations_known(given);
  const bool stated = deviations_stated(given);
  constexpr double clear = 1.5;  // of standard deviations
  const double freedom = fit.freedom;
  const double ratio =
      freedom > 0.0 ? std::sqrt(fit.channels->weighted_rss / freedom) : 0.0;
  const double chance = freedom > 0.0 ? 1.0 + 3.0 / std::sqrt(2.0 * freedom) : 0.0;
  if (absolute && ratio > std::max(clear, chance)) {
    warnings.push_back(
        {"more_than_noise",
         fmt::format("The fit leaves {:.3g} times what channel_sd or mean_sd says: "
                     "something other than noise is in the channels, and no interval "
                     "counts it. Look at the channels in channels.csv.",
                     ratio)});
  }
  if (!absolute && fit.unexplained.all > much_unexplained) {
    warnings.push_back(
        {"poor_fit", fmt::format("{} of what the channels read is not "
                                 "explained (rms): check cut, tool and axes.",
                                 base::percent(fit.unexplained.all))});
  }
  if (!absolute && !(freedom > 0.0)) {
    warnings.push_back(
        {"no_errors",
         fmt::format(
             "There are no more equations than unknowns: nothing tells how exact "
             "the numbers are. The intervals are {}. More measurements, or mean_sd, "
             "tell.",
             stated ? "by channel_sd and mean_sd as stated"
                    : "for means known to 1 % of their rms")});
  }
}

/// Means that no straight line over the feed explains as well as they are stated.
void warn_bent_means(const cases::Case& given, const Fit& fit,
                     std::vector<base::Warning>& warnings) {
  constexpr double clear = 3.0;  // of the stated deviations
  if (given.dynamometer->channel_sd.empty() || deviations_known(given)) return;
  const double ratio = std::sqrt(fit.channels->variance_factor);
  if (!(ratio > clear)) return;
  warnings.push_back(
      {"bent_means",
       fmt::format(
           "The means lie {:.3g} times channel_sd off what the model makes of them. "
           "Where they bend over the feed, teeth leave the cut at the small feeds: "
           "the edge coefficients are too small and the cutting ones too large. "
           "Leave the small feeds out, or give [runout].",
           ratio)});
}

/// Runout that is left out of means shrinks the coefficients of the edge.
void warn_means(const cases::Case& given, const Fit& fit,
                std::vector<base::Warning>& warnings) {
  if (std::ranges::none_of(given.measurements, is_mean)) return;
  const bool true_running =
      !chip::feels_runout(fit.chip.model) || geometry::runs_true(fit.runout);
  if (true_running && given.setup.cutter.teeth() > 1) {
    warnings.push_back(
        {"means_without_runout",
         "Means tell no runout. Where teeth leave the cut because of it, the edge "
         "coefficients come out too small and the cutting coefficients too large: by some "
         "5 % at 12 um in feeds from 40 um. Give [runout] and runout = \"fixed\", or use "
         "feeds well above the runout."});
  }
}

/// What a fit to channels as they are leaves aside.
void warn_not_used(const cases::Case& given, std::vector<base::Warning>& warnings) {
  if (force::form(given.law).power) {
    warnings.push_back(
        {"exponents_as_given",
         "A fit to such channels does not search the exponents of the law: "
         "they are as [force] has them, or 0.25."});
  }
  const auto& t = given.identify.tolerances;
  if (t.gain || t.turn || t.axial_depth || t.radial_depth || t.feed) {
    warnings.push_back(
        {"not_used",
         "gain_sd, turn_sd_deg and the sd of depths and feed are in no interval of a fit "
         "to such channels."});
  }
}

/// One phrase for a person where no coefficient is told alone.
std::string nothing_told(const Fit& fit) {
  const auto sums = results::sums_in_words(fit);
  return fmt::format(
      "The channels tell no coefficient alone{}. Measure at several feeds, or give a "
      "[prior].",
      sums.empty() ? std::string()
                   : fmt::format(", only {}", fmt::join(sums, " and ")));
}

/// Why a warning of this code asks for care; empty: it does not.
std::string_view care_for(std::string_view code) {
  if (code == "more_than_noise" || code == "poor_fit") {
    return "the channels contain more than the model and noise";
  }
  if (code == "bent_means") return "the means bend over the feed";
  return code == "no_errors" ? "nothing tells how exact the numbers are" : "";
}

void judge_channels(const cases::Case& given, IdentifyResult& r) {
  const Fit& fit = r.fits[*r.chosen];
  auto& warnings = r.heading.warnings;
  warn_residual(given, fit, warnings);
  if (fit.widening > 1.0) {
    warnings.push_back(
        {"correlated_residuals",
         fmt::format(
             "What the fit leaves is not noise: neighbouring samples agree "
             "(correlation {:.2f}). The intervals are {:.1f} times wider for it.",
             fit.residual_correlation, fit.widening)});
  }
  warn_bent_means(given, fit, warnings);
  warn_means(given, fit, warnings);
  warn_not_used(given, warnings);
  r.reasons_against = identification::reasons_against(fit);
  if (!r.reasons_against.empty()) {
    warnings.insert(warnings.begin(),
                    {"do_not_use", identification::do_not_use(r.reasons_against)});
  } else {
    r.reasons_for_care = identification::poorly_known(fit);
    for (const base::Warning& warning : warnings) {
      const std::string_view why = care_for(warning.code);
      if (!why.empty()) r.reasons_for_care.emplace_back(why);
    }
  }
  r.heading.message = results::identification_sentence(r);
}

}  // namespace

IdentifyResult identify_channels(const cases::Case& given, const Progress& progress) {
  IdentifyResult r;
  r.heading = heading_of(given);
  r.edge_length = given.setup.edge_length;
  progress("reading the measurements");
  const auto records = records_of(given, r.heading.warnings);
  for (const MeasuredRun& one : records) {
    r.records.push_back(
        {one.file, one.run.angle.size(), one.Omega, one.Omega_se, one.run.cut.Omega});
    r.overviews.push_back(one.overview);
  }
  const auto& dynamometer = *given.dynamometer;
  r.sensor = {.sensor = dynamometer.sensor,
              .free = dynamometer.sensor_free,
              .data = all_data(given, records),
              .files = {}};
  for (const cases::Measurement& m : given.measurements) {
    r.sensor->files.push_back(is_mean(m) ? "" : m.source.file.name);
  }
  for (const chip::Model model : given.identify.chip_models) {
    progress({"fitting, one chip model after the other",
              static_cast<double>(r.fits.size()) /
                  static_cast<double>(given.identify.chip_models.size())});
    r.fits.push_back(fit_of(given, *r.sensor, request_of(given, model, records)));
  }
  r.chosen = identification::chosen_fit(r.fits);
  if (!r.chosen) {
    r.heading.ok = false;
    r.heading.message = nothing_told(r.fits.back());
    return r;
  }
  judge_channels(given, r);
  return r;
}

}  // namespace trochoid::run
