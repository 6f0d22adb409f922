#include <trochoid/run/shared/heading.h>
#include <trochoid/run/wall/calibrate.h>

#include <trochoid/base/units.h>
#include <trochoid/run/wall/doubts.h>
#include <trochoid/run/wall/measured_wall.h>
#include <trochoid/run/wall/setting.h>
#include <trochoid/run/wall/warnings.h>

#include <fmt/core.h>

namespace trochoid::run {

namespace {

/// Why a fit was refused, and what is known all the same.
std::string refusal(const inputs::Case& given, const surface::CoefficientFit& fit) {
  std::string text = fit.message;
  if (fit.rank > 0 && fit.condition > surface::worst_condition) {
    text += fmt::format(
        " (condition {:.3g}; readings at more heights, "
        "or a wall that bends more, would)",
        fit.condition);
  }
  if (fit.known[0] != 0 || fit.known[1] != 0) {
    const auto names = force::coefficient_quantities(given.law);
    text += fmt::format("; what is known: {:.3g} {} + {:.3g} {} = {:.4g} MPa",
                        fit.known[0], names[0].key, fit.known[1], names[1].key,
                        fit.combination.value / unit::MPa);
  }
  return text;
}

}  // namespace

results::CalibrateResult calibrate(const inputs::Case& given,
                                   const Progress& progress) {
  const auto tell = [&](const char* what) { progress(what); };
  MeasuredWall wall = measured_wall(given);
  tell("Fitting the coefficients");
  results::CalibrateResult r{.heading = heading_of(given),
                             .calibration = surface::calibrate(
                                 wall_setting(given), wall.readings, wall.datum,
                                 wall_fit(given), [&] { tell("Looking for runout"); }),
                             .law = given.law,
                             .edge_length = given.setup.edge_length,
                             .order = given.setup.runout.order,
                             .teeth = given.setup.cutter.teeth()};
  r.readings = std::move(wall.readings);
  r.skipped = wall.counts.skipped;
  r.repeats = wall.counts.repeats;
  r.repeatability = wall.counts.repeatability();
  base::add(r.heading.warnings, std::move(wall.notes));
  r.datum = r.calibration.datum;
  if (!r.calibration.ok) {
    r.heading.ok = false;
    r.heading.message = refusal(given, chosen_fit(r.calibration.models));
    return r;
  }
  tell("Looking for doubts");
  const std::string origin = origin_doubt(given, r.readings, r.calibration);
  if (!origin.empty()) {
    r.heading.warnings.push_back({"origin", origin});
  }
  const std::string negative = why_negative(given, r.readings, r.calibration);
  if (!negative.empty()) {
    r.heading.ok = false;
    r.heading.message = negative;
    r.calibration.ok = false;
    return r;
  }
  withdraw_hidden_runout(given, r.readings, wall.datum, r.calibration);
  add_calibration_warnings(given, r.readings, r.calibration, r.heading.warnings);
  r.heading.message = calibration_sentence(r);
  return r;
}

}  // namespace trochoid::run
