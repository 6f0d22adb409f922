#pragma once

#include <trochoid/dynamics/cut_force.h>

#include <array>
#include <cmath>

namespace trochoid::dynamics {

/// @brief How motion at the end of a step answers to the force there.
struct StepCompliance {
  std::array<double, 3> P{};  ///< dq/dF: xx, xy, yy [m/N]
  std::array<double, 3> V{};  ///< of dq/dt [m/(N s)]; counts where flanks damp
};

/// @brief What a force makes of itself over the speed: B V, rows x, y; nothing without
/// process damping.
inline std::array<double, 4> speed_feedback(const Response& r,
                                            const std::array<double, 3>& V) noexcept {
  const auto& B = r.per_speed;
  return {B[0] * V[0] + B[1] * V[1], B[0] * V[1] + B[1] * V[2],
          B[2] * V[0] + B[3] * V[1], B[2] * V[1] + B[3] * V[2]};
}

/// @brief What it makes of itself over its motion: J P, and with process damping
/// J P + B V.
///
/// @eq T-17 dF/dF_g = J P + B V, B = dF/d(dq/dt) of T-16, V = d(dq/dt)/dF
/// @src derived
inline std::array<double, 4> feedback(const Response& r,
                                      const StepCompliance& c) noexcept {
  const auto& J = r.per_q;
  const auto& [P, V] = c;
  const std::array<double, 4> damped = speed_feedback(r, V);
  return {J[0] * P[0] + J[1] * P[1] + damped[0], J[0] * P[1] + J[1] * P[2] + damped[1],
          J[2] * P[0] + J[3] * P[1] + damped[2], J[2] * P[1] + J[3] * P[2] + damped[3]};
}

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
  NewtonStep(const Response& r, const std::array<double, 3>& P) noexcept
      : NewtonStep(std::array{r.per_q[0] * P[0] + r.per_q[1] * P[1],
                              r.per_q[0] * P[1] + r.per_q[1] * P[2],
                              r.per_q[2] * P[0] + r.per_q[3] * P[1],
                              r.per_q[2] * P[1] + r.per_q[3] * P[2]}) {}
  /// @param product  J P, or T-17
  explicit NewtonStep(const std::array<double, 4>& product) noexcept {
    const auto& [a, b, c, d] = product;
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
