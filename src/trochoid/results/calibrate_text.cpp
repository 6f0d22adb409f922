#include <trochoid/results/calibrate_text.h>

#include <trochoid/base/rounded.h>
#include <trochoid/base/units.h>
#include <trochoid/results/material.h>

#include <fmt/core.h>

#include <cmath>

namespace trochoid::results {

namespace {

using base::Estimate;
using surface::CoefficientFit;
using surface::RunoutFit;

/// `value +- half width`.
std::string pair(const Estimate& e, double unit) {
  return std::isfinite(e.se) ? fmt::format("{:.1f} +- {:.1f}", e.value / unit,
                                           (e.high - e.low) / 2 / unit)
                             : fmt::format("{:.1f} +- ?", e.value / unit);
}

/// The part after the model, in the words of `before`; nothing without feedback.
std::string feedback_after(const char* before, const CoefficientFit& fit) {
  return fit.feedback == surface::Feedback::none
             ? ""
             : fmt::format("{}{}", before, surface::name_of(fit.feedback));
}

std::string fit_row(const CalibrateResult& r, const std::string& name,
                    const surface::FoundCoefficients& found) {
  const auto names = force::coefficient_quantities(r.law);
  return fmt::format("{:<28} {:>20} {:>20} {:>8.3f} {:>10.3f}\n", name,
                     pair(found.K_tc, names[0].unit), pair(found.K_rc, names[1].unit),
                     found.correlation, found.rms / unit::um);
}

std::string model_row(const CalibrateResult& r, const CoefficientFit& fit,
                      bool counts) {
  const std::string name =
      fmt::format("{} {}{}", counts ? '*' : ' ', surface::name_of(fit.model),
                  feedback_after(" + ", fit));
  return fit.ok ? fit_row(r, name, {fit.K_tc, fit.K_rc, fit.correlation, {}, fit.rms})
                : fmt::format("{:<28} {}\n", name, fit.message);
}

std::string runout_rows(const CalibrateResult& r) {
  const RunoutFit& runout = r.calibration.runout;
  if (!runout.ok) {
    return fmt::format("runout: not known: {}\n", runout.message);
  }
  const std::string text =
      fit_row(r,
              fmt::format("{} all readings, with runout",
                          r.calibration.with_runout ? '*' : ' '),
              {runout.K_tc, runout.K_rc, runout.correlation, {}, runout.rms});
  if (!r.calibration.runout_seen) {
    return text + fmt::format("runout {} um: not clearly different from none\n",
                              pair(runout.eccentricity, unit::um));
  }
  const std::string unless_numbered =
      runout.labelled
          ? ""
          : fmt::format(" (or {:g} deg further: the teeth are not numbered)",
                        360.0 / r.teeth);
  return text + fmt::format("runout {} um at {} deg{}\n",
                            pair(runout.eccentricity, unit::um),
                            pair(runout.angle, unit::deg), unless_numbered);
}

/// What was decided, and what the other ways say.
std::string explanation_rows(const CalibrateResult& r) {
  std::string text;
  for (const surface::Explanation& e : r.calibration.explanations) {
    text += fit_row(
        r,
        fmt::format("    {:.0f} % {}{}", 100 * e.weight, surface::name_of(e.form),
                    e.feedback == surface::Feedback::none
                        ? ""
                        : fmt::format(" + {}", surface::name_of(e.feedback))),
        {e.K_tc, e.K_rc, e.correlation, {}, e.rms});
  }
  return text.empty() ? text : "  by form of the wall and feedback:\n" + text;
}

std::string runout_toml(const CalibrateResult& r) {
  const RunoutFit& runout = r.calibration.runout;
  if (!r.calibration.runout_seen) {
    return "\n# [runout]: not seen in the readings\n";
  }
  return fmt::format(
      "\n[runout]\neccentricity_mm = {}\nangle_deg = {}{}\n{}",
      runout.eccentricity.value / unit::mm, runout.angle.value / unit::deg,
      runout.labelled ? "" : "  # up to multiples of a pitch",
      r.order == geometry::EccentricityOrder::first ? "eccentricity_order = \"first\"\n"
                                                    : "");
}

}  // namespace

std::string calibration_table(const CalibrateResult& r) {
  const auto names = force::coefficient_quantities(r.law);
  std::string text =
      fmt::format("  {:<26} {:>20} {:>20} {:>8} {:>10}\n", "95 %: value +- half width",
                  names[0].key, names[1].key, "corr.", "rms um");
  const surface::ModelFits& models = r.calibration.models;
  for (std::size_t i = 0; i < models.fits.size(); ++i) {
    text += model_row(r, models.fits[i],
                      i == models.chosen && !r.calibration.with_runout &&
                          r.calibration.explanations.empty());
  }
  return text + runout_rows(r) + explanation_rows(r);
}

std::string calibrated_material(const CalibrateResult& r) {
  const CoefficientFit& chosen = chosen_fit(r.calibration.models);
  const auto names = force::coefficient_quantities(r.law);
  std::string text = fmt::format(
      "# Found by trochoid calibrate ({}{}). Use it in another case with\n"
      "#   include = \"<this file>\"\n\n[force]\nlaw = \"{}\"\n",
      surface::name_of(chosen.model), feedback_after(", feedback ", chosen),
      force::name_of(r.law));
  const Estimate* const found[] = {&r.calibration.coefficients.K_tc,
                                   &r.calibration.coefficients.K_rc};
  const std::vector<double> given = force::coefficients(r.law);
  for (std::size_t q = 0; q < names.size(); ++q) {
    if (q < std::size(found)) {
      const double se = found[q]->se / names[q].unit;
      text += fmt::format("{} = {}  # standard error {:.3g}\n", names[q].key,
                          base::as_known(found[q]->value / names[q].unit, se), se);
    } else {
      text += fmt::format("{} = {}  # as given: a wall does not show it\n",
                          names[q].key, unit::in(given[q], names[q].unit));
    }
  }
  return text + law_shape_toml(r.law, r.edge_length) + runout_toml(r);
}

}  // namespace trochoid::results
