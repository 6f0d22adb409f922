#pragma once

#include <trochoid/structure/identify_modes.h>
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

/// @brief The noise of a response from what a fit leaves of it.
///
/// @eq  M-15  var along H = a^2 + b^2 |H|^2,  var across H = a^2 + c^2 |H|^2;  a alone,
///            b = c, or b and c by themselves, whichever has the least
///            -2 ln L + q ln(2 n);  residuals are taken as r^2/(1 - h), h their leverage
/// @src derived: Gaussian noise with a floor and with fractions of magnitude and of
///      phase, by Fisher scoring; the choice by the criterion of [schwarz1978]
/// @param solution  with its leverage, if all of it can be told
NoiseEstimate estimate_noise(const FrequencyResponse& lines,
                             const ModesSolution& solution);

/// @brief The same from what any model leaves of a response.
/// @param left      measured less modelled, in the unit of H, shape (n)
/// @param leverage  of real and imaginary part in turn, shape (2 n); empty: not known
NoiseEstimate estimate_noise(const FrequencyResponse& lines,
                             std::span<const std::complex<double>> left,
                             std::span<const double> leverage);

/// @brief The weights that follow from a noise, around a model.
LineWeights weights_of(const FrequencyResponse& lines, const ResponseNoise& noise,
                       const ModesModel& model);

/// @brief The same around modelled lines, in the unit of the noise.
LineWeights weights_of(std::span<const std::complex<double>> modelled,
                       const ResponseNoise& noise);

}  // namespace trochoid::structure
