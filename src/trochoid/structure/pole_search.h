#pragma once

#include <trochoid/structure/frequency_response.h>

#include <complex>
#include <vector>

namespace trochoid::structure {

/// Damping ratio above which there is no peak worth the name.
constexpr double most_damping = 0.5;

/// One pair of poles of a receptance: R/(s-p) + conj(R)/(s-conj(p)).
struct Pole {
  std::complex<double> p;  ///< [rad/s]; above the real axis, left of the imaginary one
  std::complex<double> R;  ///< [m/(s N)]
};

struct Poles {
  std::vector<Pole> pairs;  ///< the highest peak first
  double explained = 0.0;   ///< part of the sum of |H|^2
};

/// @brief Poles of a rational function near a measured response.
///
/// @eq  M-5  sum over lines of |(N(s) - H D(s)) f/D_{j-1}(s)|^2 = min,  s = i
///           omega/omega_max: linear in N and D of round j, with the denominator of the
///           round before as the weight, and f of M-4
/// @src [sanathanan1963]; N/D_{j-1} and D/D_{j-1} as partial fractions, the zeros of
///      the latter as the next poles: vector fitting, [gustavsen1999]
///
/// No condition is set on the residues R: they tell whether the kind is right. In their
/// form as partial fractions many poles are as well conditioned as few.
/// @param response  without the line at 0 Hz
/// @param count     pairs of poles, at least 1
/// @param residual_terms  allow a constant and a term with 1/s^2 as well
Poles find_poles(const FrequencyResponse& response, int count, bool residual_terms);

}  // namespace trochoid::structure
