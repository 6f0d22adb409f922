#pragma once

#include <trochoid/signal/axes.h>
#include <trochoid/signal/transmission.h>

#include <array>
#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace trochoid::identification {

/// @brief What a dynamometer reads of a force on the tool, by harmonics of the spindle, in
/// the axes of the tool.
///
/// Reading = H(k Omega) force for each harmonic k; row-major 3x3, of e^(+i omega t). A
/// rigid dynamometer has the unit matrix everywhere.
struct Response {
  using Matrix = std::array<std::complex<double>, 9>;
  std::vector<Matrix> harmonic;  ///< from 0 on; empty: rigid. Beyond: nothing is read

  [[nodiscard]] bool rigid() const noexcept { return harmonic.empty(); }
  [[nodiscard]] int highest() const noexcept {
    return static_cast<int>(harmonic.size()) - 1;
  }
};

/// @brief A resonance of a dynamometer in one axis of the tool.
struct Resonance {
  double omega = 0.0;  ///< natural angular frequency [rad/s]
  double zeta = 0.0;   ///< damping ratio
  /// Part of the sum of squares left before by harmonics, less that of scatter, that it
  /// explains.
  double explained = 0.0;
};

using Resonances = std::array<std::optional<Resonance>, 3>;

/// @brief Turn Fourier coefficients of forces into those of readings.
/// @eq I-16 a'_m - i b'_m = H(m Omega) (a_m - i b_m)
/// @param[in,out] coefficients  a_0, a_1, b_1, ..: row-major, shape (2 highest + 1, 3,
///                              columns)
void respond(const Response& response, std::size_t columns,
             std::span<double> coefficients);

/// @brief What a measured dynamometer makes of the force on the tool: Q^-1 H Q,
/// channels = Q force.
/// @param channels  Q, which can be inverted
/// @param Omega     spindle speed [rad/s]
/// @param highest   harmonic of it that the lines of the transmission reach
Response response_on_tool(const signal::Transmission& transmission,
                          const signal::Matrix3& channels, double Omega, int highest);

}  // namespace trochoid::identification
