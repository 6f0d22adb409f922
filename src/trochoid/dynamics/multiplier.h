#pragma once

#include <trochoid/dynamics/directional.h>
#include <trochoid/dynamics/period_map.h>
#include <trochoid/dynamics/system.h>

#include <complex>

namespace trochoid::dynamics {

/// @brief Characteristic multiplier of largest modulus: by what a small disturbance
/// grows in a period.
struct Multiplier {
  std::complex<double> value;  ///< imaginary part not negative
  double error = 0.0;          ///< estimated from coarser nodes; 0: not estimated
  double factor = 1.0;         ///< of the nodes that were enough
};

/// @brief The multiplier with the nodes given.
/// @param tolerance  of the eigenvalue only
Multiplier multiplier_with(const Directional& directional, const System& system,
                           double Omega, double factor, double tolerance);

/// @brief The multiplier with nodes added until it stays.
/// @param tolerance  of |mu|, at least 1e-11; relative where |mu| is above 1
Multiplier multiplier(const Directional& directional, const System& system,
                      double Omega, double tolerance);

}  // namespace trochoid::dynamics
