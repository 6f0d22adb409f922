#include <trochoid/run/calibration_warnings.h>

#include <trochoid/base/units.h>
#include <trochoid/run/calibration_answer.h>
#include <trochoid/run/wall/warnings.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace trochoid::run {

namespace {

using surface::CoefficientFit;
using Warnings = std::vector<base::Warning>;

/// A coefficient that is negative, or known worse than to half of itself.
void judge_coefficients(const inputs::Case& given, const CoefficientFit& chosen,
                        Warnings& warnings) {
  const auto names = force::coefficient_quantities(given.law);
  const surface::Estimate* both[] = {&chosen.K_tc, &chosen.K_rc};
  for (std::size_t q = 0; q < 2; ++q) {
    const surface::Estimate& e = *both[q];
    if (e.value < 0) {
      warnings.push_back(
          {"negative_coefficient",
           fmt::format("{} = {:.3g} is negative: the readings, their sign (positive "
                       "must be material left) or the model do not fit the cut.",
                       names[q].key, e.value / names[q].unit)});
    } else if (std::isfinite(e.se) && e.high - e.low > std::abs(e.value)) {
      warnings.push_back(
          {"poorly_known",
           fmt::format(
               "{} is known to +- {:.0f} % only: more readings, at heights that "
               "the report names, would help.",
               names[q].key, 50 * (e.high - e.low) / std::abs(e.value))});
    }
  }
  if (!std::isfinite(chosen.K_tc.se)) {
    warnings.push_back({"no_spare_readings",
                        "There are as many means as unknowns: nothing tells how well "
                        "the coefficients are known."});
  }
}

std::string name_of(const CoefficientFit& answer) {
  return answer.feedback == surface::Feedback::none
             ? std::string(surface::name_of(answer.model))
             : fmt::format("{} with feedback = \"{}\"", surface::name_of(answer.model),
                           surface::name_of(answer.feedback));
}

/// Readings of the profile that differ by more than their errors.
void compare_answers(const inputs::Case& given, const surface::ModelFits& calibration,
                     Warnings& warnings) {
  constexpr double visible = 0.05;
  const auto names = force::coefficient_quantities(given.law);
  const CoefficientFit& chosen = calibration.fits[calibration.chosen];
  for (std::size_t i = 0; i < calibration.fits.size(); ++i) {
    const CoefficientFit& other = calibration.fits[i];
    if (i == calibration.chosen || !other.ok) {
      continue;
    }
    const double change = std::max(std::abs(other.K_tc.value / chosen.K_tc.value - 1),
                                   std::abs(other.K_rc.value / chosen.K_rc.value - 1));
    if (change < visible) {
      continue;
    }
    const bool spring_back = other.model == surface::Model::imprint &&
                             chosen.model == surface::Model::envelope;
    warnings.push_back(
        {"answers_differ",
         fmt::format("Read as {}, the same means give {} = {:.4g} and {} = {:.4g} "
                     "MPa (as {}: {:.4g} and {:.4g}){}",
                     name_of(other), names[0].key, other.K_tc.value / names[0].unit,
                     names[1].key, other.K_rc.value / names[1].unit, name_of(chosen),
                     chosen.K_tc.value / names[0].unit,
                     chosen.K_rc.value / names[1].unit,
                     spring_back ? ": the linear reading leaves out that the wall "
                                   "springs back under the next tooth."
                                 : ".")});
  }
}

void judge_means(const inputs::Case& given, const surface::ModelFits& calibration,
                 Warnings& warnings) {
  const auto uneven =
      std::count_if(calibration.nominal.begin(), calibration.nominal.end(),
                    [](const surface::Nominal& n) { return !n.whole; });
  const bool single =
      std::all_of(calibration.nominal.begin(), calibration.nominal.end(),
                  [](const surface::Nominal& n) { return n.readings.size() == 1; });
  if (single && given.setup.cutter.teeth() > 1) {
    warnings.push_back(
        {"single_readings",
         "There is one reading at each place: it counts as the mean over a turn of the "
         "feed. If it is not, the runout is in it."});
  } else if (uneven > 0) {
    warnings.push_back(
        {"uneven_readings",
         fmt::format("{} of {} means are not over whole multiples of {} teeth: runout "
                     "does not drop out of them.",
                     uneven, calibration.nominal.size(), given.setup.cutter.teeth())});
  }
}

void judge_runout(const inputs::Case& given, const surface::RunoutFit& runout,
                  Warnings& warnings) {
  const auto& offsets = given.setup.runout.radial_offsets;
  if (given.setup.runout.eccentricity != 0 ||
      std::any_of(offsets.begin(), offsets.end(), [](double r) { return r != 0; })) {
    warnings.push_back(
        {"runout_not_used", "[runout] is not used: calibrate looks for it itself."});
  }
  if (runout.ok && !runout_is_seen(runout)) {
    warnings.push_back(
        {"no_runout",
         fmt::format("An eccentricity of {:.2g} +- {:.2g} um (one standard error) is "
                     "not clearly different from none.",
                     runout.eccentricity.value / unit::um,
                     runout.eccentricity.se / unit::um)});
  }
  if (runout_counts(given, runout)) {
    warnings.push_back(
        {"runout_in_mean",
         "The mean of a real surface is not free of runout: the coefficients are those "
         "that were fitted together with it."});
  } else if (runout_is_seen(runout) &&
             given.machine.surface->model == surface::Model::envelope) {
    const auto names = force::coefficient_quantities(given.law);
    warnings.push_back(
        {"runout_in_mean",
         fmt::format("The answer with feedback is one of means, and the mean of a real "
                     "surface is not free of runout: fitted together with it, without "
                     "feedback, {} = {:.4g} and {} = {:.4g}.",
                     names[0].key, runout.K_tc.value / names[0].unit, names[1].key,
                     runout.K_rc.value / names[1].unit)});
  }
}

/// What is said of feedback in general does not help a fit that cannot take it in.
void judge_bending(const inputs::Case& given, const surface::RunoutFit& runout,
                   double largest, Warnings& warnings) {
  Warnings bending;
  add_bending_warnings(given, largest, bending);
  for (base::Warning& warning : bending) {
    if (warning.code == "feedback" && runout_counts(given, runout)) {
      warning.message =
          "The deflection is large enough to even out the teeth, which the fit with "
          "runout leaves out: the cutter may run out more than found, and the "
          "coefficients may be off by some per cent.";
    }
    warnings.push_back(warning);
  }
}

}  // namespace

void add_calibration_warnings(const inputs::Case& given, const MeasuredWall& wall,
                              const surface::ModelFits& calibration,
                              const surface::RunoutFit& runout,
                              std::vector<base::Warning>& warnings) {
  const CoefficientFit& chosen = calibration.fits[calibration.chosen];
  double largest = 0.0;
  for (const surface::Reading& r : wall.readings) {
    largest = std::max(largest, std::abs(r.error));
  }
  if (largest == 0) {
    warnings.push_back({"all_zero", "All readings are zero: so are the coefficients."});
    return;
  }
  CoefficientFit judged = chosen;
  if (runout_counts(given, runout)) {
    judged.K_tc = runout.K_tc;
    judged.K_rc = runout.K_rc;
  }
  judge_coefficients(given, judged, warnings);
  compare_answers(given, calibration, warnings);
  judge_means(given, calibration, warnings);
  judge_runout(given, runout, warnings);
  judge_bending(given, runout, largest, warnings);
}

}  // namespace trochoid::run
