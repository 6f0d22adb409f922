#pragma once

#include <array>
#include <complex>
#include <variant>
#include <vector>

/// The motion of the table that cancels runout, and the command that produces it.
namespace trochoid::correction {

/// @brief x = mean + Re sum over n of c_n e^(i n phi), n = 1, 2, ...
struct Harmonics {
  double mean = 0.0;                    ///< [m]
  std::vector<std::complex<double>> c;  ///< c[n - 1] [m]
};

/// @brief A polynomial in u = (phi - from)/(to - from).
struct Segment {
  double from = 0.0;          ///< [rad]
  double to = 0.0;            ///< [rad], above from
  std::array<double, 6> c{};  ///< of 1, u, ..., u^5 [m]
};

/// Segments of one turn: ascending, without gaps.
struct Segments {
  std::vector<Segment> all;
};

/// @brief A motion, or a command, that repeats with every turn of the spindle.
using PeriodicMotion = std::variant<Harmonics, Segments>;

/// Place and derivatives with respect to the spindle angle.
struct MotionPoint {
  double x = 0.0;          ///< [m]
  double slope = 0.0;      ///< [m/rad]
  double curvature = 0.0;  ///< [m/rad^2]
};

MotionPoint motion_at(const PeriodicMotion& motion, double phi) noexcept;
double place_at(const PeriodicMotion& motion, double phi) noexcept;  ///< [m]

/// The motion times a factor.
PeriodicMotion scaled(const PeriodicMotion& motion, double factor);

/// @brief The motion that comes earlier by an angle [rad].
PeriodicMotion advanced(const PeriodicMotion& motion, double angle);

/// @brief Mean and harmonics 1 to n_max of a motion.
///
/// @eq R-6 c_n = (1/pi) integral over a turn of x(phi) e^(-i n phi) dphi
/// @src definition
Harmonics harmonics_of(const PeriodicMotion& motion, int n_max);

/// Smallest and largest place [m], and what is largest of the rest.
struct Range {
  double low = 0.0;
  double high = 0.0;
  double slope = 0.0;      ///< largest |slope| [m/rad]; infinite at a jump
  double curvature = 0.0;  ///< largest |curvature| [m/rad^2]; infinite at a kink

  [[nodiscard]] double peak_to_peak() const noexcept { return high - low; }
  [[nodiscard]] double middle() const noexcept { return (low + high) / 2; }
};

Range range_of(const PeriodicMotion& motion);

/// Angles in [0, 2 pi) at which a motion is not smooth [rad], ascending.
std::vector<double> breaks_of(const PeriodicMotion& motion);

/// @brief Harmonics of values at equally spaced angles from 0.
/// @param n_max  below half of the number of values
Harmonics harmonics_of_samples(const std::vector<double>& x, int n_max);

}  // namespace trochoid::correction
