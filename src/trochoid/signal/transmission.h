#pragma once

#include <array>
#include <complex>
#include <vector>

namespace trochoid::signal {

/// @brief What the channels of a dynamometer read of a force, by frequency.
///
/// Reading of channel i over a force of unit size along what channel j stands for; of a
/// rigid, calibrated dynamometer the unit matrix at every frequency.
struct Transmission {
  using Matrix = std::array<std::complex<double>, 9>;  ///< row-major

  std::vector<double> omega;  ///< [rad/s], increasing, shape (n)
  std::vector<Matrix> H;      ///< shape (n), of e^(+i omega t)
};

/// @brief The response at a frequency, linear between lines. Below the first line it is
/// the real part of that: a static response has no phase.
/// @param omega  [rad/s], from 0 to the last line; beyond that the last line holds
Transmission::Matrix at(const Transmission& transmission, double omega);

}  // namespace trochoid::signal
