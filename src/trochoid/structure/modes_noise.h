#pragma once

#include <trochoid/structure/modes_fit.h>
#include <trochoid/structure/modes_problem.h>

#include <complex>
#include <span>

namespace trochoid::structure {

/// What the noise of a response is taken for.
struct NoiseEstimate {
  ResponseNoise noise;
  int parameters = 1;
  double deviance = 0.0;  ///< -2 ln likelihood, less a constant
};

/// @brief The noise of a response from what a model leaves of it.
///
/// @eq  M-15  var along H = a^2 + b^2 |H|^2,  var across H = a^2 + c^2 |H|^2;  a alone,
///            b = c, or b and c by themselves, whichever has the least
///            -2 ln L + q ln(2 n);  residuals are taken as r^2/(1 - h), h their leverage
/// @src derived: Gaussian noise with a floor and with fractions of magnitude and of
///      phase, by Fisher scoring; the choice by the criterion of [schwarz1978]
/// @param left      measured less modelled, in the unit of H, shape (n)
/// @param leverage  of real and imaginary part in turn, shape (2 n); empty: not known
NoiseEstimate estimate_noise(const FrequencyResponse& lines,
                             std::span<const std::complex<double>> left,
                             std::span<const double> leverage);

/// @brief The weights that follow from a noise, around modelled lines.
LineWeights weights_of(std::span<const std::complex<double>> modelled,
                       const ResponseNoise& noise);

}  // namespace trochoid::structure
