#include <trochoid/run/commands.h>

#include <trochoid/base/units.h>
#include <trochoid/run/wall.h>
#include <trochoid/surface/doubts.h>

#include <fmt/core.h>

namespace trochoid::run {

namespace {

/// Why a fit was refused, and what is known all the same.
std::string refusal(const cases::Case& given, const surface::CoefficientFit& fit) {
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

std::string both(const cases::Case& given, const surface::Estimate& K_tc,
                 const surface::Estimate& K_rc) {
  const auto names = force::coefficient_quantities(given.law);
  return fmt::format("{} = {:.4g} and {} = {:.4g}", names[0].key,
                     K_tc.value / names[0].unit, names[1].key,
                     K_rc.value / names[1].unit);
}

std::string why_negative(const cases::Case& given,
                         const surface::FoundCoefficients& found,
                         const surface::NegativeCoefficients& negative) {
  if (negative.wrong_sign) {
    return fmt::format(
        "the readings have the wrong sign: positive must be where material is left; "
        "turned round they give {}",
        both(given, negative.K_tc, negative.K_rc));
  }
  const auto names = force::coefficient_quantities(given.law);
  const bool first = found.K_tc.value < 0;
  const surface::Estimate& e = first ? found.K_tc : found.K_rc;
  const force::Quantity& name = names[first ? 0 : 1];
  return fmt::format(
      "the readings do not tell {}: it comes out as {:.3g}, known to lie between {:.3g} "
      "and {:.3g}; readings at more heights, or a wall that bends more, would tell it",
      name.key, e.value / name.unit, e.low / name.unit, e.high / name.unit);
}

std::string origin_in_words(const cases::Case& given,
                            const surface::OriginDoubt& doubt) {
  return fmt::format(
      "x begins at {:.4g} mm: is it counted from the start of the scan? It counts from "
      "the end of the wall. {:.4g} mm farther along, about position_mm, {} {}.",
      doubt.first / unit::mm, doubt.by / unit::mm, both(given, doubt.K_tc, doubt.K_rc),
      doubt.better ? fmt::format("fit better ({:.3g} instead of {:.3g} um left)",
                                 doubt.new_rms / unit::um, doubt.rms / unit::um)
                   : "fit as well");
}

/// Take the runout back where the readings follow feedback that the case leaves out.
void withdraw_hidden_runout(const cases::Case& given, const surface::Setting& setting,
                            const MeasuredWall& wall, results::CalibrateResult& r) {
  const auto hidden = surface::eccentricity_hidden_by_feedback(
      setting, r.readings, wall.datum, wall_fit(given), r.calibration);
  if (!hidden) return;
  r.calibration.runout.ok = false;
  r.calibration.runout.message = fmt::format(
      "the readings follow the feedback of the deflection, which feedback = \"none\" "
      "leaves out: with it the eccentricity is {:.3g} +- {:.2g} um",
      hidden->value / unit::um, (hidden->high - hidden->low) / 2 / unit::um);
  r.calibration.runout_seen = false;
}

}  // namespace

results::CalibrateResult calibrate(const cases::Case& given, const Progress& progress) {
  if (given.machine.surface_measurements.front().of == cases::MeasuredOf::finish) {
    return calibrate_finish(given, progress);
  }
  const auto tell = [&](const char* what) { progress(what); };
  MeasuredWall wall = measured_wall(given);
  const surface::Setting setting = wall_setting(given);
  tell("Fitting the coefficients");
  results::CalibrateResult r{.heading = heading_of(given),
                             .calibration = surface::calibrate(
                                 setting, wall.readings, wall.datum, wall_fit(given),
                                 [&] { tell("Looking for runout"); }),
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
  if (given.machine.wall) {
    if (const auto doubt =
            surface::origin_doubt(setting, r.readings, r.calibration,
                                  given.machine.wall->length, wall_position(given))) {
      r.heading.warnings.push_back({"origin", origin_in_words(given, *doubt)});
    }
  }
  if (const auto negative =
          surface::negative_coefficients(setting, r.readings, r.calibration)) {
    r.heading.ok = false;
    r.heading.message = why_negative(given, r.calibration.coefficients, *negative);
    r.calibration.ok = false;
    return r;
  }
  withdraw_hidden_runout(given, setting, wall, r);
  add_calibration_warnings(given, r.readings, r.calibration, r.heading.warnings);
  r.heading.message = calibration_sentence(r);
  return r;
}

}  // namespace trochoid::run
