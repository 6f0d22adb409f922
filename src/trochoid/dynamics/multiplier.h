#pragma once

#include <trochoid/dynamics/directional.h>
#include <trochoid/dynamics/period_map.h>
#include <trochoid/dynamics/system.h>

#include <complex>
#include <functional>

namespace trochoid::dynamics {

/// @brief Characteristic multiplier of largest modulus: by what a small disturbance
/// grows in a period.
struct Multiplier {
  std::complex<double> value;  ///< imaginary part not negative
  double error = 0.0;          ///< estimated; 0: not estimated
  double factor = 1.0;         ///< of the nodes that were enough
  int steps = 0;               ///< that its search took
};

/// With so many times the nodes a multiplier is checked.
inline constexpr double more_nodes = 1.25;

/// @brief The multiplier with the nodes given.
/// @param tolerance  of the eigenvalue only
Multiplier multiplier_with(const Directional& directional, const System& system,
                           double Omega, double factor, double tolerance);

/// @brief The multiplier of a map that is there; its error where all is smooth.
///
/// @eq  D-14 error of mu = (30 e^2 + e/1000) |mu|
/// @src derived; the numbers bound what was measured
/// @param factor     of its nodes, for the answer
/// @param tolerance  of the eigenvalue only
/// @param expected   steps that a map like this took; 0: not known
Multiplier multiplier_of(PeriodMap& map, double factor, double tolerance,
                         int expected = 0);

/// @brief A multiplier that nodes are added to until it stays.
/// @param with       the multiplier with a factor of the nodes
/// @param tolerance  as below
Multiplier settled(const std::function<Multiplier(double factor)>& with,
                   double tolerance);

/// @brief The multiplier with nodes added until it stays.
/// @param tolerance  of |mu|, at least 1e-11; relative where |mu| is above 1
Multiplier multiplier(const Directional& directional, const System& system,
                      double Omega, double tolerance);

}  // namespace trochoid::dynamics
