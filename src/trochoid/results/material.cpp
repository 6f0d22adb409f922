#include <trochoid/results/material.h>

#include <trochoid/base/rounded.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/fit.h>
#include <trochoid/identification/reliability.h>

#include <fmt/core.h>

namespace trochoid::results {

namespace {

using identification::Fit;

/// Axial offsets and tilt.
std::string deep_runout_toml(const Fit& fit) {
  std::string text;
  const geometry::Runout& runout = fit.runout;
  for (std::size_t k = 0; k < runout.axial_offsets.size(); ++k) {
    text += fmt::format("{}{}", k > 0 ? ", " : "axial_offsets_mm = [",
                        unit::in(runout.axial_offsets[k], unit::mm));
  }
  if (!text.empty()) text += "]\n";
  return text + fmt::format("tilt_deg = {}\ntilt_angle_deg = {}\n",
                            unit::in(runout.tilt, unit::deg),
                            unit::in(runout.tilt_angle, unit::deg));
}

std::string runout_toml(const Fit& fit) {
  for (const auto& [what, why] : fit.unidentifiable) {
    if (what.starts_with("radial_offsets_mm") || what == "eccentricity_mm" ||
        what == "angle_deg") {
      return fmt::format("\n# [runout]: {}: {}\n", what, why);
    }
  }
  std::string text = "\n[runout]\nradial_offsets_mm = [";
  for (std::size_t k = 0; k < fit.runout.radial_offsets.size(); ++k) {
    const double se =
        k < fit.radial_offsets_se.size() ? fit.radial_offsets_se[k].value_or(0.0) : 0.0;
    text += fmt::format("{}{}", k > 0 ? ", " : "",
                        base::as_known(unit::in(fit.runout.radial_offsets[k], unit::mm),
                                       se / unit::mm));
  }
  text += fmt::format("]\neccentricity_mm = {}\nangle_deg = {}\n",
                      unit::in(fit.runout.eccentricity, unit::mm),
                      unit::in(fit.runout.angle, unit::deg));
  if (fit.runout.order == geometry::EccentricityOrder::first) {
    text += "eccentricity_order = \"first\"\n";
  }
  if (!geometry::level(fit.runout)) text += deep_runout_toml(fit);
  return text;
}

}  // namespace

std::string law_shape_toml(const force::Law& law, force::EdgeLength edge_length) {
  std::string text;
  const force::Form form = force::form(law);
  const auto exponents = force::exponent_quantities(law);
  for (std::size_t q = 0; q < exponents.size(); ++q) {
    text += fmt::format("{} = {}\n", exponents[q].key, form.m[q]);
  }
  if (form.edge) {
    text += fmt::format("edge_length = \"{}\"\n", force::name_of(edge_length));
  }
  return text;
}

std::string material_toml(const Fit& fit, force::EdgeLength edge_length,
                          std::string_view command) {
  return material_toml(fit, identification::groups_of(fit).front(), edge_length,
                       command);
}

std::string material_toml(const Fit& fit, const identification::Group& group,
                          force::EdgeLength edge_length, std::string_view command) {
  std::string text;
  if (const auto reasons = identification::reasons_against(fit); !reasons.empty()) {
    text += "# " + identification::do_not_use(reasons) + "\n\n";
  }
  text += fmt::format(
      "# Found by trochoid {}. Use it in another case with\n"
      "#   include = \"<this file>\"\n",
      command);
  if (fit.groups.size() > 1) {
    text += fmt::format("# Of {}.\n", identification::label_of_group(group.name));
  }
  if (fit.residual_correlation > identification::noise_correlation) {
    text += fmt::format(
        "# What the fit leaves is not noise: the intervals are {:.1f} times wider for it.\n",
        fit.widening);
  }
  text += "\n[force]\n";
  text += fmt::format("law = \"{}\"\n", force::name_of(group.law));
  const auto names = force::coefficient_quantities(group.law);
  for (std::size_t q = 0; q < names.size(); ++q) {
    if (group.coefficients[q]) {
      const auto& K = *group.coefficients[q];
      const double half = 0.5 * (K.high - K.low) / names[q].unit;
      text += fmt::format("{} = {}  # 95 %: +- {:.2g}\n", names[q].key,
                          base::as_known(K.value / names[q].unit, half), half);
    } else {
      text += fmt::format("# {} is not identifiable from this record\n", names[q].key);
    }
  }
  text += law_shape_toml(group.law, edge_length);
  if (!chip::feels_runout(fit.chip.model)) {
    return text;
  }
  return text + runout_toml(fit);
}

}  // namespace trochoid::results
