#pragma once

#include <trochoid/dynamics/cut_force.h>

#include <array>
#include <cmath>

namespace trochoid::dynamics {

/// @brief (I - J P)^-1 of T-6 with J = dF/dq and P = dq/dF: from how far a force is off
/// to what it should be.
struct NewtonStep {
  double xx = 1.0;
  double xy = 0.0;
  double yx = 0.0;
  double yy = 1.0;
  double strength = 0.0;  ///< size of J P
  /// A feedback within a step weaker than this may be met with an old slope, and to
  /// first order.
  static constexpr double mild = 0.03;

  NewtonStep() = default;
  NewtonStep(const Response& r, const std::array<double, 3>& P) noexcept {
    const auto& J = r.per_q;
    const double a = J[0] * P[0] + J[1] * P[1];
    const double b = J[0] * P[1] + J[1] * P[2];
    const double c = J[2] * P[0] + J[3] * P[1];
    const double d = J[2] * P[1] + J[3] * P[2];
    strength = std::abs(a) + std::abs(b) + std::abs(c) + std::abs(d);
    xx = 1 + a;
    xy = b;
    yx = c;
    yy = 1 + d;
    if (strength > mild) {
      const double whole = 1 / ((1 - a) * (1 - d) - b * c);
      xx = (1 - d) * whole;
      xy = b * whole;
      yx = c * whole;
      yy = (1 - a) * whole;
    }
  }
};

}  // namespace trochoid::dynamics
