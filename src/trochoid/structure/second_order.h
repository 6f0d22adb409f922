#pragma once

#include <cmath>

namespace trochoid::structure {

/// The two motions of x'' + 2 a x' + wn2 x = 0 that M-2 and M-9 are made of.
struct Decay {
  double C = 1.0;  ///< e^{-a t} cos(omega_d t)
  double D = 0.0;  ///< e^{-a t} sin(omega_d t)/omega_d [s]
};

/// @brief Both, smooth through the critical damping, and without overflow above it.
/// @param a    [1/s]
/// @param wn2  [rad^2/s^2], above 0
/// @param t    [s], at least 0
inline Decay decaying(double a, double wn2, double t) noexcept {
  const double b2 = a * a - wn2;
  if (std::abs(b2) * t * t < 1e-8) {  // both series, the rest is below 1e-17
    const double e = std::exp(-a * t);
    return {e * (1 + b2 * t * t / 2), e * t * (1 + b2 * t * t / 6)};
  }
  const double b = std::sqrt(std::abs(b2));
  if (b2 < 0) {
    const double e = std::exp(-a * t);
    return {e * std::cos(b * t), e * std::sin(b * t) / b};
  }
  const double slow = std::exp(-(wn2 / (a + b)) * t);  // a - b, without cancellation
  const double fast = std::exp(-(a + b) * t);
  return {(slow + fast) / 2, (slow - fast) / (2 * b)};
}

}  // namespace trochoid::structure
