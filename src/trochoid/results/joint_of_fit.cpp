#include <trochoid/results/joint_of_fit.h>

#include <trochoid/base/units.h>
#include <trochoid/identification/fit.h>

#include <fmt/core.h>

#include <algorithm>

namespace trochoid::results {

namespace {

using identification::Fit;
using identification::Found;
using identification::FoundKind;

/// A name of the case, and the unit of it.
struct Named {
  std::string name;
  double unit = 1.0;
};

Named named(const force::Law& law, const Found& found) {
  switch (found.kind) {
    case FoundKind::coefficient: {
      const force::Quantity q = force::coefficient_quantities(law)[found.at];
      return {fmt::format("force.{}", q.key), q.unit};
    }
    case FoundKind::exponent:
      return {fmt::format("force.{}", force::exponent_quantities(law)[found.at].key)};
    case FoundKind::offset:
      return {fmt::format("runout.radial_offsets_mm[{}]", found.at + 1), unit::mm};
    case FoundKind::eccentricity_x:
      return {"runout.e_x_mm", unit::mm};
    case FoundKind::eccentricity_y:
      return {"runout.e_y_mm", unit::mm};
    case FoundKind::axial_offset:
      return {fmt::format("runout.axial_offsets_mm[{}]", found.at + 1), unit::mm};
    case FoundKind::tilt_x:
      return {"runout.t_x"};
    case FoundKind::tilt_y:
      return {"runout.t_y"};
  }
  return {};
}

/// The same of a name that a fit gives to what it does not know; empty: of no other case.
std::string key_of(const Fit& fit, std::size_t group, const std::string& what) {
  const std::string own =
      fit.groups.size() > 1
          ? fmt::format(" of {}",
                        identification::label_of_group(fit.groups[group].name))
          : std::string();
  for (const force::Quantity& q : force::quantities(fit.law)) {
    const bool shared = q.role == force::Role::exponent;
    if (what == fmt::format("{}{}", q.key, shared ? "" : own)) {
      return fmt::format("force.{}", q.key);
    }
  }
  const bool runout = what.starts_with("radial_offsets_mm") ||
                      what.starts_with("axial_offsets_mm") || what == "tilt_deg" ||
                      what == "eccentricity_mm" || what == "angle_deg";
  return runout ? "runout." + what : std::string();
}

void add_not_found(const Fit& fit, std::size_t group, Joint& joint) {
  const bool components =
      std::ranges::find(joint.names, "runout.e_x_mm") != joint.names.end();
  for (const auto& [what, why] : fit.unidentifiable) {
    const std::string key = key_of(fit, group, what);
    // Amount and angle may be open where the components are known.
    const bool known =
        components && !key.starts_with("runout.radial") && key.starts_with("runout.");
    if (!key.empty() && !known) {
      joint.not_found.emplace_back(key, why);
    }
  }
  for (const std::string& what : fit.on_edge) {
    joint.not_found.emplace_back(
        key_of(fit, group, what),
        "found where a tooth just starts or stops cutting: without a standard error");
  }
}

}  // namespace

Joint joint_of(const Fit& fit, std::size_t group) {
  Joint joint{.law = std::string(force::name_of(fit.law)),
              .chip_model = std::string(chip::name_of(fit.chip.model))};
  const auto& all = fit.found.unknowns;
  std::vector<std::size_t> places;
  std::vector<double> units;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].kind == FoundKind::coefficient && all[i].group != group) continue;
    const Named one = named(fit.law, all[i]);
    places.push_back(i);
    units.push_back(one.unit);
    add_found(joint, one.name, all[i].value / one.unit, fit.interval_factor);
    if (one.name.starts_with("runout.")) {
      joint.teeth = fit.runout.radial_offsets.size();
    }
  }
  std::vector<double> covariance;
  for (const std::size_t i : places) {
    for (const std::size_t j : places) {
      covariance.push_back(fit.found.covariance[i * all.size() + j]);
    }
  }
  set_covariance(joint, covariance, units);
  add_not_found(fit, group, joint);
  return joint;
}

}  // namespace trochoid::results
