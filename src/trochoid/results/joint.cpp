#include <trochoid/results/joint.h>

namespace trochoid::results {

void add_found(Joint& joint, std::string name, double value, double factor) {
  joint.names.push_back(std::move(name));
  joint.values.push_back(value);
  joint.factors.push_back(factor);
}

void set_covariance(Joint& joint, std::span<const double> covariance,
                    std::span<const double> units) {
  const std::size_t n = units.size();
  if (covariance.size() != n * n || joint.names.size() != n) {
    joint = {};
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      joint.covariance.push_back(covariance[i * n + j] / (units[i] * units[j]));
    }
  }
}

double interval_factor(const base::Estimate& estimate) {
  return estimate.se > 0 ? 0.5 * (estimate.high - estimate.low) / estimate.se
                         : base::normal_interval;
}

const Fields<Joint>& joint_fields() {
  static const Fields<JointMode> mode{
      {"body", "that moves", &JointMode::body},
      {"axis", "along which it moves", &JointMode::axis}};
  using Lost = std::pair<std::string, std::string>;
  static const Fields<Lost> not_found{{"name", "a key of a case", &Lost::first},
                                      {"why", "it was not found", &Lost::second}};
  static const Fields<Joint> all{
      {"law", "of the coefficients, where there are some", &Joint::law,
       [](const Joint& j) { return !j.law.empty(); }},
      {"chip_model", "that they were found with", &Joint::chip_model,
       [](const Joint& j) { return !j.chip_model.empty(); }},
      {"teeth", "of the runout, where there is one", &Joint::teeth,
       [](const Joint& j) { return j.teeth > 0; }},
      {"modes", "of modes.toml, in its order", mode, &Joint::modes,
       [](const Joint& j) { return !j.modes.empty(); }},
      {"names",
       "keys of a case: `force.K_tc_MPa`, `runout.radial_offsets_mm[2]`, "
       "`mode[1].frequency_Hz`, `mode[1].damping_ratio`, `mode[1].mass_kg`. An "
       "eccentricity stands as `runout.e_x_mm`, `runout.e_y_mm`: rho cos(lambda), rho "
       "sin(lambda)",
       &Joint::names},
      {"found", "as found, in the unit of the name", &Joint::values},
      {"interval_factors",
       "half of each 95 % interval over the square root of its variance",
       &Joint::factors},
      {"matrix", "covariance that gives the intervals (U-1), row by row",
       [](const Joint& j) {
         const auto n = static_cast<std::ptrdiff_t>(j.names.size());
         Array rows;
         for (auto row = j.covariance.begin(); row != j.covariance.end(); row += n) {
           rows.emplace_back(Array(row, row + n));
         }
         return rows;
       }},
      {"not_found", "what was looked for and is not among the names", not_found,
       &Joint::not_found}};
  return all;
}

std::optional<Joint> found_or_none(Joint joint) {
  return joint.names.empty() ? std::nullopt : std::optional(std::move(joint));
}

Value joint_value(const Joint& joint) {
  return joint.names.empty() ? Value() : joint_fields().object(joint);
}

}  // namespace trochoid::results
