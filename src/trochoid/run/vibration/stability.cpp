#include <trochoid/run/shared/heading.h>
#include <trochoid/run/vibration/stability.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/frequency_limit.h>
#include <trochoid/run/vibration/problem.h>
#include <trochoid/run/vibration/tool_point.h>
#include <trochoid/run/vibration/warnings.h>

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace trochoid::run {

namespace {

using results::ByFrequency;
using results::MeasuredStability;

/// Of the directional matrices, as elsewhere far below what is asked of a depth.
constexpr double matrix_tolerance = 1e-10;
/// Depths up to the greatest that are looked at for a limit.
constexpr int depths_looked_at = 100;

ByFrequency by_frequency(const dynamics::StabilityProblem& problem,
                         const dynamics::PointResponse& response, int harmonics,
                         double greatest, const Progress& progress) {
  const dynamics::DirectionalModel model(problem.setup, problem.law,
                                         problem.options.chip_floor, matrix_tolerance);
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

MeasuredStability measured_stability(const inputs::Case& given,
                                     const dynamics::StabilityProblem& problem,
                                     const ToolPoint& point, const Progress& progress) {
  const double a_p = problem.setup.cut.a_p;
  MeasuredStability out{
      .band = dynamics::band_of(point.response),
      .harmonics = given.machine.stability->harmonics,
      .modes_fitted = given.machine.modes.empty() && point.no_modes.empty(),
      .greatest_depth =
          problem.depths.empty() ? a_p : std::max(a_p, problem.depths.back())};
  out.zeroth_order =
      by_frequency(problem, point.response, 0, out.greatest_depth, progress);
  out.multi_frequency = by_frequency(problem, point.response, out.harmonics,
                                     out.greatest_depth, progress);
  return out;
}

void warn_of(const results::StabilityResult& r, const ToolPoint& point,
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

results::StabilityResult stability(const inputs::Case& given, const Progress& progress,
                                   base::Stop stop) {
  results::StabilityResult r{.heading = heading_of(given),
                             .problem = stability_problem(given)};
  r.problem.stop = stop;
  std::optional<ToolPoint> point;
  if (!given.machine.measured_frfs.empty()) {
    point = tool_point(given, r.heading.warnings);
    if (given.machine.modes.empty()) {
      r.problem.system = point->modes;
      r.no_modes = point->no_modes;
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
