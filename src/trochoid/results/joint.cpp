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

Value joint_value(const Joint& joint) {
  if (joint.names.empty()) {
    return nullptr;
  }
  const std::size_t n = joint.names.size();
  Array matrix;
  for (std::size_t i = 0; i < n; ++i) {
    Array row;
    for (std::size_t j = 0; j < n; ++j) {
      row.emplace_back(joint.covariance[i * n + j]);
    }
    matrix.emplace_back(std::move(row));
  }
  Object out;
  if (!joint.law.empty()) {
    out.push_back({"law", joint.law});
  }
  if (!joint.chip_model.empty()) {
    out.push_back({"chip_model", joint.chip_model});
  }
  if (joint.teeth > 0) {
    out.push_back({"teeth", joint.teeth});
  }
  if (!joint.modes.empty()) {
    Array modes;
    for (const JointMode& mode : joint.modes) {
      modes.emplace_back(Object{{"body", mode.body}, {"axis", mode.axis}});
    }
    out.push_back({"modes", std::move(modes)});
  }
  Array not_found;
  for (const auto& [name, why] : joint.not_found) {
    not_found.emplace_back(Object{{"name", name}, {"why", why}});
  }
  out.push_back({"names", joint.names});
  out.push_back({"found", joint.values});
  out.push_back({"interval_factors", joint.factors});
  out.push_back({"matrix", std::move(matrix)});
  out.push_back({"not_found", std::move(not_found)});
  return out;
}

}  // namespace trochoid::results
