#include <trochoid/run/commands.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/dynamics/frequency_limit.h>
#include <trochoid/run/modes.h>
#include <trochoid/run/problems.h>
#include <trochoid/run/vibration.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace trochoid::run {

namespace {

using dynamics::MeasuredReceptance;
using dynamics::MeasuredResponse;
using Warnings = std::vector<base::Warning>;
using results::ByFrequency;
using results::MeasuredStability;

/// Noise above this fraction of the response at the chatter frequency is told.
constexpr double loud_noise = 0.02;
/// Lines between the half-power points of the strongest resonance that are few.
constexpr std::size_t few_lines_in_peak = 5;

std::string name_of_part(const MeasuredReceptance& part) {
  constexpr std::array<const char*, 2> axes = {"x", "y"};
  return part.motion == part.force ? fmt::format("along {}", axes[part.motion])
                                   : fmt::format("of {} to a force along {}",
                                                 axes[part.motion], axes[part.force]);
}

/// A response in its band. A line at an end of it belongs to it, whatever rounding did.
structure::FrequencyResponse in_band(const cases::MeasuredFrf& frf,
                                     structure::FrequencyResponse response) {
  if (frf.band.size() != 2) {
    return response;
  }
  structure::FrequencyResponse out{.kind = response.kind, .omega = {}, .H = {}};
  for (std::size_t i = 0; i < response.omega.size(); ++i) {
    const double f = response.omega[i] / unit::Hz;
    if (f >= frf.band[0] * (1 - 1e-12) && f <= frf.band[1] * (1 + 1e-12)) {
      out.omega.push_back(response.omega[i]);
      out.H.push_back(response.H[i]);
    }
  }
  return out;
}

/// @throws base::InputError for too few lines, and a sensor that points against the force
void check(const cases::MeasuredFrf& frf, const MeasuredReceptance& part) {
  if (part.omega.size() < dynamics::fewest_lines) {
    throw base::InputError(
        {fmt::format("{}: {} has {} lines above 0 Hz{}; must have at least {}",
                     frf.source.file.location, frf.source.file.path, part.omega.size(),
                     frf.band.empty() ? "" : " in band_Hz", dynamics::fewest_lines)});
  }
  if (dynamics::moves_against_force(part)) {
    throw base::InputError({fmt::format(
        "{}: {}: the tool point would move against the force (the imaginary part of "
        "the receptance is positive at its peaks): the sensor points against the "
        "hammer, or kind is wrong; change the sign of the response, or `kind`",
        frf.source.file.location, frf.source.file.path)});
  }
}

void warn_of_peaks(const MeasuredReceptance& part, Warnings& warnings) {
  std::string coarse;
  std::size_t count = 0;
  const dynamics::Peak* greatest = nullptr;
  const std::vector<dynamics::Peak> all = dynamics::peaks(part);
  for (const dynamics::Peak& peak : all) {
    if (greatest == nullptr || peak.height > greatest->height) greatest = &peak;
    if (peak.lines >= few_lines_in_peak) continue;
    ++count;
    coarse += fmt::format("{}{:.5g} Hz ({})", coarse.empty() ? "" : ", ",
                          peak.omega / unit::Hz, peak.lines);
  }
  if (count > 0) {
    warnings.push_back(
        {"few_lines",
         fmt::format(
             "Few lines of the response {} lie between the half-power points of "
             "its peak{} at {}: the limit depth hangs on them. A longer record "
             "has a finer resolution.",
             name_of_part(part), count == 1 ? "" : "s", coarse)});
  }
  if (greatest != nullptr && greatest->at_the_edge) {
    warnings.push_back(
        {"peak_at_the_edge",
         fmt::format("The response {} is largest at the edge of its band, {:.5g} Hz: a "
                     "resonance may lie outside, which nothing here can see.",
                     name_of_part(part), greatest->omega / unit::Hz)});
  }
}

/// Of the directional matrices, as elsewhere far below what is asked of a depth.
constexpr double matrix_tolerance = 1e-10;
/// Depths up to the greatest that are looked at for a limit.
constexpr int depths_looked_at = 100;

ByFrequency by_frequency(const dynamics::StabilityProblem& problem,
                         const dynamics::PointResponse& response, int harmonics,
                         double greatest, const Progress& progress) {
  const double fastest = dynamics::band_of(response).to / unit::turn;
  const dynamics::DirectionalModel model(problem.setup, problem.law,
                                         problem.options.chip_floor, matrix_tolerance,
                                         dynamics::reach_of(problem, fastest));
  std::vector<double> depths;
  for (int i = 1; i <= depths_looked_at; ++i) {
    depths.push_back(greatest * i / depths_looked_at);
  }
  const dynamics::FrequencyOptions options{.harmonics = harmonics,
                                           .stop = problem.stop};
  const std::string what = harmonics == 0 ? "zeroth order" : "multi-frequency";
  const auto tell = [&](double share) { progress({what, share}); };
  ByFrequency out{dynamics::frequency_limit(model, response, problem.setup.cut.Omega,
                                            depths, options),
                  dynamics::frequency_limits(model, response, problem.spindle_speeds,
                                             depths, options, tell)};
  if (problem.stop.wanted()) {  // a gap would say that there is no limit in it
    out.curve.clear();
  }
  return out;
}

MeasuredStability measured_stability(const cases::Case& given,
                                     const dynamics::StabilityProblem& problem,
                                     const dynamics::ToolPoint& point,
                                     const Progress& progress) {
  const double a_p = problem.setup.cut.a_p;
  MeasuredStability out{.band = dynamics::band_of(point.response),
                        .harmonics = given.machine.stability->harmonics,
                        .modes_fitted = given.machine.modes.empty() && !point.no_modes,
                        .complex_modes = point.complex_modes,
                        .real_modes = point.real_modes,
                        .greatest_depth = problem.depths.empty()
                                              ? a_p
                                              : std::max(a_p, problem.depths.back())};
  out.zeroth_order =
      by_frequency(problem, point.response, 0, out.greatest_depth, progress);
  out.multi_frequency = by_frequency(problem, point.response, out.harmonics,
                                     out.greatest_depth, progress);
  return out;
}

/// Limits that differ by more than this fraction are not one answer.
constexpr double same_limit = 0.05;
/// Modes that leave more than this fraction of the response near the chatter frequency,
/// and so many times its scatter, do not describe it.
constexpr double worst_misfit = 0.03;
constexpr double beyond_noise = 3.0;

/// The limits of both solutions where they differ; of one depth only where the other has
/// none.
struct TwoLimits {
  double by_modes = 0.0;     ///< [m]; 0: none
  double by_response = 0.0;  ///< the same
  double frequency = 0.0;    ///< of the lower [Hz]
};

std::optional<TwoLimits> different_limits(const results::StabilityResult& r) {
  const auto& modes = r.stability.limit;
  const auto& response = r.measured->multi_frequency.limit;
  if (!r.no_modes.empty() || (!modes && !response)) {
    return std::nullopt;
  }
  TwoLimits out;
  if (modes) {
    out.by_modes = modes->limit.depth;
    out.frequency = modes->lines.empty() ? 0.0 : modes->lines.front().frequency;
  }
  if (response) {
    const bool lower = !modes || response->depth < out.by_modes;
    out.by_response = response->depth;
    out.frequency = lower ? response->chatter_frequency : out.frequency;
  }
  const bool alike = modes && response &&
                     std::abs(out.by_response - out.by_modes) <=
                         same_limit * std::min(out.by_modes, out.by_response);
  return alike ? std::nullopt : std::optional(out);
}

/// What judges the cut, and a warning where the other solution says something else.
results::JudgedBy judged_by(const results::StabilityResult& r,
                            const dynamics::ToolPoint& point, Warnings& warnings) {
  using results::JudgedBy;
  if (!r.no_modes.empty()) {
    return JudgedBy::response;
  }
  const JudgedBy modes = r.measured->modes_fitted && r.measured->complex_modes
                             ? JudgedBy::complex_modes
                             : JudgedBy::modes;
  const auto limits = different_limits(r);
  if (!limits) {
    return modes;
  }
  const dynamics::Misfit misfit =
      dynamics::misfit_near(point, r.problem.system, limits->frequency * unit::Hz);
  const bool poor =
      misfit.modes > worst_misfit && misfit.modes > beyond_noise * misfit.noise;
  const bool by_response = poor && r.measured->modes_fitted;
  const auto words = [](double depth) {
    return depth > 0 ? fmt::format("{:.3g} mm", depth / unit::mm)
                     : std::string("no limit");
  };
  warnings.push_back(
      {"solutions_differ",
       fmt::format(
           "The Floquet multiplier of the modes gives {}, the measured response "
           "alone {}. Near {:.5g} Hz the modes leave {:.1f} % of the response{}. "
           "Verdict and diagram come from {}.",
           words(limits->by_modes), words(limits->by_response), limits->frequency,
           100 * misfit.modes, poor ? "" : ", little more than its noise",
           by_response ? "the response" : "the modes")});
  return by_response ? JudgedBy::response : modes;
}

void warn_of(const results::StabilityResult& r, const dynamics::ToolPoint& point,
             std::vector<base::Warning>& warnings) {
  const auto& limit = r.measured->multi_frequency.limit;
  if (limit) {
    const double pitch =
        unit::turn / static_cast<double>(r.problem.setup.cutter.pitch.size());
    warn_of_response(point, limit->chatter_frequency * unit::Hz,
                     unit::turn * limit->Omega / pitch, warnings);
  }
}

/// What there was no time for.
void warn_of_time(const results::StabilityResult& r,
                  std::vector<base::Warning>& warnings) {
  const std::size_t asked = r.problem.spindle_speeds.size();
  const std::size_t done = r.no_modes.empty() ? r.stability.lobes.Omega.size() : 0;
  warnings.insert(
      warnings.begin(),
      {"time_limit",
       done == 0
           ? "The time was up before the lobes: only the cut of the case was "
             "looked at, and no limit over the speed."
           : fmt::format("The time was up: lobes.csv has {} of the {} speeds, and "
                         "limits over the speed that were not finished are left "
                         "out. Lobes between the speeds are not seen.",
                         done, asked)});
}

}  // namespace

std::vector<MeasuredResponse> tool_responses(const cases::Case& given,
                                             Warnings& warnings) {
  std::vector<MeasuredResponse> all;
  for (const cases::MeasuredFrf& frf : given.machine.measured_frfs) {
    files::FrfFile file = frf.response.get();
    base::add(warnings, std::move(file.notes));
    all.push_back({.response = in_band(frf, std::move(file.response)),
                   .motion = static_cast<std::size_t>(frf.axis),
                   .force = static_cast<std::size_t>(frf.force_axis.value_or(frf.axis)),
                   .of_table = frf.body == cases::ModeBody::table});
    const MeasuredReceptance part = dynamics::receptance_of(all.back());
    check(frf, part);
    warn_of_peaks(part, warnings);
  }
  return all;
}

void warn_of_response(const dynamics::ToolPoint& point, double chatter, double step,
                      Warnings& warnings) {
  const dynamics::Band band = dynamics::band_of(point.response);
  const auto response = dynamics::receptance(point.response, chatter);
  for (std::size_t i = 0; i < point.response.parts.size(); ++i) {
    const dynamics::MeasuredReceptance& part = point.response.parts[i];
    const double size = std::abs(response[3 * part.motion]);
    if (part.motion == part.force && point.noise[i] > loud_noise * size && size > 0) {
      warnings.push_back(
          {"noise",
           fmt::format("The lines of the response {} scatter by {:.1f} % of it at the "
                       "chatter frequency of {:.5g} Hz: a limit depth from it is no "
                       "better than that. Average more blows, or use modes.",
                       name_of_part(part), 100 * point.noise[i] / size,
                       chatter / unit::Hz)});
    }
  }
  if (chatter + step > band.to) {
    warnings.push_back(
        {"band_short_above",
         fmt::format("The response ends at {:.5g} Hz, less than a tooth passing "
                     "frequency above the chatter frequency of {:.5g} Hz: harmonics "
                     "beyond it count as rigid, and what vibrates there is not seen.",
                     band.to / unit::Hz, chatter / unit::Hz)});
  }
  if (chatter < 1.5 * band.from) {
    warnings.push_back(
        {"band_short_below",
         fmt::format(
             "The chatter frequency of {:.5g} Hz lies near the lower end of the "
             "response, {:.5g} Hz: below it the static compliance is taken from "
             "the lowest line, and a slower resonance is not seen.",
             chatter / unit::Hz, band.from / unit::Hz)});
  }
}

results::StabilityResult stability(const cases::Case& given, const Progress& progress,
                                   base::Stop stop) {
  results::StabilityResult r{.heading = heading_of(given),
                             .problem = stability_problem(given)};
  r.problem.stop = stop;
  std::optional<dynamics::ToolPoint> point;
  if (!given.machine.measured_frfs.empty()) {
    const bool fit_modes = given.machine.modes.empty();
    const auto responses = tool_responses(given, r.heading.warnings);
    if (fit_modes) progress("Fitting the modes");
    point = dynamics::tool_point(responses, fit_modes);
    if (fit_modes) r.problem.system = point->modes;
    for (const dynamics::FoundDelay& found : point->delays) {
      const auto& of = responses[found.response];
      if (of.motion != of.force) continue;  // that of the direct ones
      add_delay_warning(
          found.delay,
          fmt::format(" in {}",
                      given.machine.measured_frfs[found.response].source.file.name),
          r.heading.warnings);
    }
    if (const auto& none = point->no_modes) {
      const std::string& file =
          given.machine.measured_frfs[none->response].source.file.path;
      r.no_modes = fmt::format("{}: {}", file, none->reason);
    }
  }
  if (r.no_modes.empty()) {
    r.stability = dynamics::stability(r.problem, [&](const char* what, double done) {
      progress({what, done});
    });
    base::add(r.heading.warnings,
              stability_warnings(given, r.problem.options, r.stability));
  }
  if (point) {
    r.measured = measured_stability(given, r.problem, *point, progress);
    warn_of(r, *point, r.heading.warnings);
    r.judged_by = judged_by(r, *point, r.heading.warnings);
  }
  if (!r.no_modes.empty()) {
    r.heading.warnings.push_back(
        {"no_modes", fmt::format("No Floquet multiplier: no modes could be fitted to "
                                 "the measured response. {}",
                                 r.no_modes)});
  }
  if (!r.stability.whole || (r.measured && stop.wanted())) {
    warn_of_time(r, r.heading.warnings);
  }
  r.heading.message = results::stability_sentence(r);
  return r;
}

}  // namespace trochoid::run
