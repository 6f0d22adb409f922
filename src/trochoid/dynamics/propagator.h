#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::dynamics {

/// @brief A linear system z' = A z + B u over steps in which u changes linearly.
///
/// @eq T-3 z(t + dt) = Phi z(t) + G_0 u(t) + G_1 u(t + dt), exact
/// @src derived: exponential of the system with u and u' as states
struct Propagator {
  std::size_t states = 0;
  std::size_t inputs = 0;
  std::vector<double> Phi;  ///< row-major, shape (states, states)
  std::vector<double> G_0;  ///< row-major, shape (states, inputs)
  std::vector<double> G_1;  ///< row-major, shape (states, inputs)
};

/// @param A  row-major, shape (states, states)
/// @param B  row-major, shape (states, inputs)
/// @param dt step [s], positive
Propagator propagator(std::span<const double> A, std::span<const double> B,
                      std::size_t states, double dt);

}  // namespace trochoid::dynamics
