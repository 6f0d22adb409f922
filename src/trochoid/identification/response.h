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

/// @brief A resonance of a dynamometer, or the low-pass of its amplifier, in one axis of the
/// tool.
struct Resonance {
  double omega = 0.0;                   ///< natural angular frequency [rad/s]
  double zeta = 0.0;                    ///< damping ratio
  std::optional<double> omega_se = {};  ///< [rad/s]
  std::optional<double> zeta_se = {};
};

using Resonances = std::array<std::optional<Resonance>, 3>;

/// What is searched of a resonance.
enum class ResonanceUnknown { ln_omega, ln_zeta };

/// @brief What one oscillator reads of a force of unit amplitude.
/// @eq I-17 H = 1/(1 - x^2 + 2 i zeta x), x = omega/omega_n
std::complex<double> oscillation(double omega, const Resonance& resonance);

/// @brief What a dynamometer with these resonances reads.
/// @param Omega    spindle speed [rad/s]
/// @param highest  harmonic
Response response_of(const Resonances& resonances, double Omega, int highest);

/// @brief A response whose axes ring besides.
Response with_resonances(Response response, const Resonances& resonances, double Omega);

/// @brief The derivative of with_resonances by an unknown of one of its axes.
Response slope_of_resonance(Response response, const Resonances& resonances,
                            double Omega, std::size_t axis, ResonanceUnknown unknown);

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
