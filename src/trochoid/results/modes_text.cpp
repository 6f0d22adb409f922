#include <trochoid/results/modes_parts.h>

#include <trochoid/base/estimate.h>
#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <cmath>

namespace trochoid::results {

using structure::FittedMode;
using structure::FittedResponse;
using structure::ModesFit;

namespace {

std::string cell(const structure::Known& known, double size) {
  return fmt::format("{:.6g} +- {:.2g}", known.value / size,
                     base::normal_interval * known.se / size);
}

/// What the short table says of one response below its modes.
std::string words_of_one(const ModesFit& fit) {
  const FittedResponse& one = fit.responses.front();
  std::string text = fmt::format(
      "(+-: half of a 95 % interval) from {} lines of the {}, {:.4g} to {:.4g} Hz{}\n"
      "the fit explains {:.3f} % of the power and leaves {:.3g} {} (rms)\n",
      one.omega.size(), name_of(one.kind), one.omega.front() / unit::Hz,
      one.omega.back() / unit::Hz,
      fit.residual_terms || !fit.outside.empty()
          ? ", with terms for modes outside of it"
          : "",
      100 * one.explained, one.rms, unit_of(one.kind));
  text +=
      fmt::format("noise: a floor of {:.3g} {}", one.noise.floor, unit_of(one.kind));
  if (one.noise.magnitude > 0 || one.noise.phase > 0) {
    text +=
        fmt::format(" and {:.2g} % of the magnitude, {:.2g} deg of phase",
                    100 * one.noise.magnitude, unit::in(one.noise.phase, unit::deg));
  }
  return text + "\n";
}

/// The same of several responses.
std::string words_of_shared(const ModesResult& r) {
  const ModesFit& fit = r.fit;
  std::string text = fmt::format(
      "(+-: half of a 95 % interval; angle of the direction from +x towards +y, mass of "
      "motion along it)\n{} shapes, {}\n",
      fit.complex_shapes ? "complex" : "real",
      fit.residual_terms || !fit.outside.empty()
          ? "with terms for modes outside the band"
          : "without terms for modes outside");
  for (std::size_t q = 0; q < r.responses.size(); ++q) {
    const FittedResponse& one = fit.responses[q];
    text += fmt::format(
        "{}: {} lines of the {}, {:.4g} to {:.4g} Hz; the fit explains {:.3f} %\n",
        r.responses[q].name, one.omega.size(), name_of(one.kind),
        one.omega.front() / unit::Hz, one.omega.back() / unit::Hz, 100 * one.explained);
  }
  for (const structure::Reciprocity& pair : fit.reciprocity) {
    text +=
        fmt::format("reciprocity: {} is {} times {}\n", r.responses[pair.other].name,
                    cell(pair.gain, 1), r.responses[pair.one].name);
  }
  if (fit.reciprocity.empty() && r.responses.size() > 1) {
    text +=
        "reciprocity: not checked, as one cross response was measured; its sign says to "
        "which side the modes lie\n";
  }
  return text;
}

}  // namespace

NearAxis near_axis(const ModesResult& r, const FittedMode& mode) {
  if (mode.phi.size() < 2) {
    return {name_of(r.responses.front().motion), 0.0};
  }
  const double angle = mode.angle.value / unit::deg;
  if (std::abs(angle) <= 45) {
    return {"x", angle};
  }
  return {"y", angle > 0 ? angle - 90 : angle + 90};
}

std::string modes_toml(const ModesResult& r) {
  std::string text =
      r.shared
          ? "# Found by trochoid modes in several responses together. Use it in another "
            "case with\n#   include = \"<this file>\"\n"
          : "# Found by trochoid modes. Use it in another case with\n"
            "#   include = \"<this file>\"\n"
            "# or, together with other files, with\n"
            "#   include = [\"<this file>\", \"<another one>\"]\n"
            "# A list of modes in the case itself replaces the modes of all files.\n";
  if (r.fit.complex_shapes) {
    text += "# The shapes are complex: these are the real modes nearest to them.\n";
  }
  for (const FittedMode& m : r.fit.real_modes) {
    const NearAxis at = near_axis(r, m);
    text += fmt::format(
        "\n[[mode]]  # {:.6g} Hz, damping ratio {:.4g}\n"
        "body = \"{}\"\naxis = \"{}\"\n",
        m.omega.value / unit::Hz, m.zeta.value, name_of(r.body), at.axis);
    if (m.phi.size() > 1) {
      text += fmt::format("angle_deg = {}  # standard error {:.2g}\n", at.angle,
                          m.angle.se / unit::deg);
    }
    text += fmt::format(
        "mass_kg = {}  # standard error {:.2g}\n"
        "stiffness_N_per_m = {}  # {:.2g}\n"
        "damping_Ns_per_m = {}  # {:.2g}\n",
        m.mass.value, m.mass.se, m.stiffness.value, m.stiffness.se, m.damping.value,
        m.damping.se);
  }
  return text;
}

std::string short_table(const ModesResult& r) {
  const ModesFit& fit = r.fit;
  std::string text =
      "mode  frequency [Hz]    damping ratio      mass [kg]          "
      "stiffness [N/m]    ";
  text += !r.shared            ? "damping [N s/m]\n"
          : fit.complex_shapes ? "angle [deg]      imaginary fraction\n"
                               : "angle [deg]      \n";
  for (std::size_t i = 0; i < fit.modes.size(); ++i) {
    const FittedMode& m = fit.modes[i];
    text += fmt::format("{:>4}  {:<16}  {:<17}  {:<17}  {:<17}  ", i + 1,
                        cell(m.omega, unit::Hz), cell(m.zeta, 1), cell(m.mass, 1),
                        cell(m.stiffness, 1));
    text += r.shared ? fmt::format("{:<15}  {}\n",
                                   m.phi.size() > 1 ? cell(m.angle, unit::deg) : "-",
                                   fit.complex_shapes ? cell(m.imaginary, 1) : "")
                     : cell(m.damping, 1) + "\n";
  }
  return text + (r.shared ? words_of_shared(r) : words_of_one(fit));
}

}  // namespace trochoid::results
