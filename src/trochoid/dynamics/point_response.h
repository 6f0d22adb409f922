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

/// @brief G at a frequency (D-20).
///
/// @eq  D-34 between lines H (omega - p) is the parabola through the four around, p their
///           pole: the third divided difference of H (omega - p) is 0; without a pole
///           that the lines beside them see too, the cubic
/// @src derived: one resonance and what varies slowly beside it
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

/// A peak of a response.
struct Peak {
  double omega = 0.0;        ///< [rad/s]
  double width = 0.0;        ///< between its half-power points [rad/s]
  std::size_t lines = 0;     ///< there
  double height = 0.0;       ///< |H| [m/N]
  bool at_the_edge = false;  ///< of the band: a resonance may lie outside
};

/// @brief The peaks of a response that fall to half of their power on both sides, or
/// to an end of the band: of a twentieth of the greatest at least, and above the scatter.
std::vector<Peak> peaks(const MeasuredReceptance& part);

}  // namespace trochoid::dynamics
