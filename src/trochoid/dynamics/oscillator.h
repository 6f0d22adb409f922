#pragma once

#include <trochoid/dynamics/system.h>

#include <array>
#include <vector>

namespace trochoid::dynamics {

/// @brief How a free oscillator goes on: (eta, eta') after a time.
///
/// @eq D-3 Phi = e^(-sigma t) [C + sigma S, S; -omega_0^2 S, C - sigma S],
///         C = cos(omega_d t), S = sin(omega_d t)/omega_d; cosh and sinh beyond
///         critical damping
/// @src elementary
/// @return row-major, shape (2, 2)
std::array<double, 4> free_motion(const ChipMode& mode, double t) noexcept;

/// @brief An oscillator on an element, driven by a force given at its nodes.
struct DrivenMotion {
  std::vector<double>
      eta;  ///< of the force at the nodes, row-major, shape (n + 1, n + 1)
  std::vector<double> velocity;             ///< the same of eta'
  std::vector<std::array<double, 4>> free;  ///< D-3 from the start to each node
};

/// @brief Response to a force that is a polynomial between nodes, by Gauss quadrature
/// of the exact kernel.
///
/// @eq D-4 eta(t) = Phi(t - a) state(a) + integral from a to t of e^(-sigma (t - s))
///         S(t - s) f(s)/m ds
/// @src elementary
/// @param n         degree of the element
/// @param duration  of the element [s]
DrivenMotion driven_motion(const ChipMode& mode, int n, double duration);

}  // namespace trochoid::dynamics
