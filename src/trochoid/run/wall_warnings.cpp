#include <trochoid/run/wall.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace trochoid::run {

namespace {

using surface::CoefficientFit;
using Warnings = std::vector<base::Warning>;

/// A coefficient that is known worse than to half of itself.
void judge_coefficients(const cases::Case& given,
                        const surface::FoundCoefficients& found, Warnings& warnings) {
  const auto names = force::coefficient_quantities(given.law);
  const surface::Estimate* both[] = {&found.K_tc, &found.K_rc};
  for (std::size_t q = 0; q < 2; ++q) {
    const surface::Estimate& e = *both[q];
    if (std::isfinite(e.se) && e.high - e.low > std::abs(e.value)) {
      warnings.push_back(
          {"poorly_known",
           fmt::format(
               "{} is known to +- {:.0f} % only: more readings, at heights that "
               "the report names, would help.",
               names[q].key, 50 * (e.high - e.low) / std::abs(e.value))});
    }
  }
  if (!std::isfinite(found.K_tc.se)) {
    warnings.push_back({"no_spare_readings",
                        "There are as many means as unknowns: nothing tells how well "
                        "the coefficients are known."});
  }
}

/// Which readings were left out, and how far off they are.
void judge_outliers(std::span<const surface::Reading> readings,
                    const surface::Calibration& calibration, Warnings& warnings) {
  constexpr std::size_t named = 5;
  std::vector<surface::Outlier> out = calibration.outliers;
  if (out.empty()) {
    return;
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
    return std::abs(a.residual) > std::abs(b.residual);
  });
  std::string which;
  for (std::size_t i = 0; i < std::min(named, out.size()); ++i) {
    const surface::Reading& r = readings[out[i].reading];
    which += fmt::format("{}x {:.6g} mm, height {:.4g} mm: {:+.3g} um",
                         i > 0 ? "; " : "", unit::in(r.travel, unit::mm),
                         unit::in(r.height, unit::mm), out[i].residual / unit::um);
  }
  warnings.push_back(
      {"outliers",
       fmt::format(
           "{} of {} readings lie far from what the others say and are left out: "
           "{}{}.",
           out.size(), readings.size(), which, out.size() > named ? " and more" : "")});
}

/// What the readings decided, where it was not clear.
void judge_explanations(const cases::Case& given,
                        const surface::Calibration& calibration, Warnings& warnings) {
  constexpr double clear = 0.8;
  const auto& tried = calibration.explanations;
  if (tried.size() < 2 || tried.front().weight > clear) {
    return;
  }
  const auto names = force::coefficient_quantities(given.law);
  std::string which;
  for (std::size_t i = 0; i < tried.size() && tried[i].weight > 0.05; ++i) {
    which += fmt::format(
        "{}{:.0f} % for form {} with feedback {} ({} = {:.4g}, {} = {:.4g})",
        i > 0 ? ", " : "", 100 * tried[i].weight, surface::name_of(tried[i].form),
        surface::name_of(tried[i].feedback), names[0].key,
        tried[i].K_tc.value / names[0].unit, names[1].key,
        tried[i].K_rc.value / names[1].unit);
  }
  warnings.push_back(
      {"not_decided",
       fmt::format(
           "The readings do not decide how they came about: {}. The answer is "
           "the mean over these explanations. State form or feedback if you know "
           "it.",
           which)});
}

std::string full_name(const CoefficientFit& fit) {
  return fit.feedback == surface::Feedback::none
             ? std::string(surface::name_of(fit.model))
             : fmt::format("{} with feedback = \"{}\"", surface::name_of(fit.model),
                           surface::name_of(fit.feedback));
}

/// Readings of the profile that differ by more than their errors.
void compare_models(const cases::Case& given, const surface::ModelFits& models,
                    Warnings& warnings) {
  constexpr double visible = 0.05;
  const auto names = force::coefficient_quantities(given.law);
  const CoefficientFit& chosen = chosen_fit(models);
  for (std::size_t i = 0; i < models.fits.size(); ++i) {
    const CoefficientFit& other = models.fits[i];
    if (i == models.chosen || !other.ok) {
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
                     full_name(other), names[0].key, other.K_tc.value / names[0].unit,
                     names[1].key, other.K_rc.value / names[1].unit, full_name(chosen),
                     chosen.K_tc.value / names[0].unit,
                     chosen.K_rc.value / names[1].unit,
                     spring_back ? ": the linear reading leaves out that the wall "
                                   "springs back under the next tooth."
                                 : ".")});
  }
}

void judge_means(const cases::Case& given, const surface::ModelFits& models,
                 Warnings& warnings) {
  const auto uneven = std::count_if(models.nominal.begin(), models.nominal.end(),
                                    [](const surface::Nominal& n) { return !n.whole; });
  const bool single =
      std::all_of(models.nominal.begin(), models.nominal.end(),
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
                     uneven, models.nominal.size(), given.setup.cutter.teeth())});
  }
}

void judge_runout(const cases::Case& given, const surface::Calibration& calibration,
                  Warnings& warnings) {
  const surface::RunoutFit& runout = calibration.runout;
  const auto& offsets = given.setup.runout.radial_offsets;
  if (given.setup.runout.eccentricity != 0 ||
      std::any_of(offsets.begin(), offsets.end(), [](double r) { return r != 0; })) {
    warnings.push_back(
        {"runout_not_used", "[runout] is not used: calibrate looks for it itself."});
  }
  if (runout.ok && !calibration.runout_seen) {
    warnings.push_back(
        {"no_runout",
         fmt::format("An eccentricity of {:.2g} +- {:.2g} um (one standard error) is "
                     "not clearly different from none.",
                     runout.eccentricity.value / unit::um,
                     runout.eccentricity.se / unit::um)});
  }
  if (calibration.with_runout && calibration.explanations.empty()) {
    warnings.push_back(
        {"runout_in_mean",
         "The mean of a real surface is not free of runout: the coefficients are those "
         "that were fitted together with it."});
  } else if (calibration.runout_seen && calibration.explanations.empty() &&
             chosen_fit(calibration.models).model == surface::Model::envelope) {
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
void judge_bending(const cases::Case& given, const surface::Calibration& calibration,
                   double largest, Warnings& warnings) {
  Warnings bending;
  add_bending_warnings(given, largest,
                       surface::radial_depth(given.setup.cut.engagement), bending);
  const bool decided = !given.machine.surface.value_or(cases::Surface{}).feedback &&
                       !calibration.explanations.empty();
  for (base::Warning& warning : bending) {
    if (warning.code == "feedback" && decided) {
      continue;
    }
    if (warning.code == "feedback" && calibration.with_runout) {
      warning.message =
          "The deflection is large enough to even out the teeth, which the fit with "
          "runout leaves out: the cutter may run out more than found, and the "
          "coefficients may be off by some per cent.";
    }
    warnings.push_back(warning);
  }
}

/// A plate is linear below half of its thickness only.
void add_load_warnings(const results::SurfaceResult& r, Warnings& warnings) {
  for (std::size_t i = 0; r.loads && i < r.loads->walls.size(); ++i) {
    const structure::LoadedWall& wall = r.loads->walls[i];
    if (std::abs(wall.largest) > r.wall->thickness / 2) {
      warnings.push_back(
          {"thick_deflection",
           fmt::format("Under {} the wall deflects by {:.3g} mm, more than half of its "
                       "thickness: a thin plate bends in proportion only below that.",
                       name_of(wall.load), wall.largest / unit::mm)});
    }
  }
}

}  // namespace

void add_bending_warnings(const cases::Case& given, double largest, double a_e,
                          Warnings& warnings) {
  constexpr double visible = 0.01;
  if (given.machine.wall && largest > given.machine.wall->thickness / 2) {
    warnings.push_back(
        {"thick_deflection",
         fmt::format(
             "The error of {:.3g} mm is more than half of the wall's thickness: "
             "a thin plate bends in proportion to the force only below that.",
             largest / unit::mm)});
  }
  if (wall_feedback(given) == surface::Feedback::none && largest > visible * a_e) {
    warnings.push_back(
        {"feedback",
         fmt::format("The error is {:.2g} % of the radial depth: the "
                     "deflection itself makes the cut smaller, which "
                     "feedback = \"{}\" takes into account.",
                     100 * largest / a_e,
                     given.setup.runout.eccentricity > 0 ? "regenerative" : "entry")});
  }
}

void add_surface_warnings(const cases::Case& given, const results::SurfaceResult& r,
                          Warnings& warnings) {
  const surface::ErrorMap& map = r.map;
  const auto largest = [](const surface::MeanAndExtremes& error) {
    return std::max(std::abs(error.max), std::abs(error.min));
  };
  if (r.passes.empty()) {
    add_bending_warnings(given, largest(map.error),
                         surface::radial_depth(given.setup.cut.engagement), warnings);
  } else {
    // Of the pass whose error is the largest part of what it was to take off.
    const surface::PassOutcome* worst = nullptr;
    const auto part = [&](const surface::PassOutcome& p) {
      return largest(p.error) / p.radial_depth.max;
    };
    for (const surface::PassOutcome& p : r.passes) {
      if (p.cut.a_e > 0 && (worst == nullptr || part(p) > part(*worst))) {
        worst = &p;
      }
    }
    if (worst != nullptr) {
      add_bending_warnings(given, largest(worst->error), worst->radial_depth.max,
                           warnings);
    }
  }
  add_load_warnings(r, warnings);
  for (std::size_t i = 0; i < r.passes.size(); ++i) {
    if (r.passes[i].without_feedback) {
      warnings.push_back(
          {"without_feedback",
           fmt::format(
               "Pass {} hardly touches the wall: it bends by less than 0.1 um and "
               "was taken without feedback.",
               i + 1)});
    }
  }
  if (!given.machine.cutter_body && !given.machine.wall) {
    warnings.push_back(
        {"rigid", "Neither [cutter_body] nor [wall] is given: nothing bends."});
  }
  if (map.model == surface::Model::quasi_static) {
    warnings.push_back(
        {"quasi_static",
         "quasi_static is the deflection at every spindle angle, as the paper has it: "
         "a pulse of force, not the profile that stays on the wall."});
  }
}

void add_calibration_warnings(const cases::Case& given,
                              std::span<const surface::Reading> readings,
                              const surface::Calibration& calibration,
                              Warnings& warnings) {
  double largest = 0.0;
  for (const surface::Reading& r : readings) {
    largest = std::max(largest, std::abs(r.error));
  }
  if (largest == 0) {
    warnings.push_back({"all_zero", "All readings are zero: so are the coefficients."});
    return;
  }
  judge_outliers(readings, calibration, warnings);
  judge_coefficients(given, calibration.coefficients, warnings);
  judge_explanations(given, calibration, warnings);
  compare_models(given, calibration.models, warnings);
  judge_means(given, calibration.models, warnings);
  judge_runout(given, calibration, warnings);
  judge_bending(given, calibration, largest, warnings);
}

}  // namespace trochoid::run
