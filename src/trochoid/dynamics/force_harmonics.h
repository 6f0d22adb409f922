#pragma once

#include <trochoid/dynamics/directional.h>
#include <trochoid/dynamics/point_response.h>

#include <vector>

namespace trochoid::dynamics {

/// @brief Fourier coefficients of the directional matrices.
///
/// @eq  D-21 A_d(phi) = sum over n of A_d^n e^(i n 2 pi phi / P),
///           A_d^n = (1/P) integral over the period P of A_d e^(-i n 2 pi phi / P)
/// @src definition; the mean n = 0 is that of [altintas1995]
struct ForceHarmonics {
  double period = 0.0;         ///< P [rad]
  std::vector<double> delays;  ///< [rad], as of the Directional
  int most = 0;                ///< n from -most to most
  /// Shape (1 + delays, 2 most + 1) [N/m]: first what acts on q(phi).
  std::vector<std::vector<ComplexMatrix2>> coefficients;
  /// The same of what acts on dq/dphi, shape (2 most + 1) [N]; empty: nothing.
  std::vector<ComplexMatrix2> damping;
};

/// @param most  largest n, at least 0
ForceHarmonics force_harmonics(const Directional& directional, int most);

}  // namespace trochoid::dynamics
