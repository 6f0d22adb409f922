#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

/// The tool point as it was measured: no modes, but how it answers to each frequency.
namespace trochoid::dynamics {

/// @brief One measured receptance: motion along one axis over the force along one.
struct MeasuredReceptance {
  std::size_t motion = 0;               ///< axis of the motion, 0: x, 1: y
  std::size_t force = 0;                ///< axis of the force, 0: x, 1: y
  std::vector<double> omega;            ///< [rad/s], ascending, above 0, shape (n)
  std::vector<std::complex<double>> H;  ///< [m/N], shape (n), n at least 2
};

/// @brief How tool against work answers to the force between them.
///
/// @eq  D-20 q(omega) = G(omega) F(omega), G = sum of the receptances of tool and work;
///           G(-omega) = conj G(omega); below the band the real part of its lowest
///           line, above it 0
/// @src derived: the force on the work is opposite, and so is its motion in q (D-2)
struct PointResponse {
  std::vector<MeasuredReceptance> parts;
};

/// 2 x 2, row-major [m/N].
using ComplexMatrix2 = std::array<std::complex<double>, 4>;

/// @brief G at a frequency (D-20): between lines by the cubic through the four around.
/// @param omega  [rad/s], any sign
ComplexMatrix2 receptance(const PointResponse& point, double omega) noexcept;

/// Where all of the parts were measured.
struct Band {
  double from = 0.0;  ///< [rad/s]
  double to = 0.0;    ///< [rad/s]
};
Band band_of(const PointResponse& point) noexcept;

/// @brief The mean distance of two lines, of the part with the finest [rad/s].
double line_distance(const PointResponse& point) noexcept;

/// @brief Distance of the half-power points of the sharpest of the greatest peaks
/// [rad/s].
double narrowest_peak(const PointResponse& point) noexcept;

}  // namespace trochoid::dynamics
