#pragma once

#include <numbers>

/// Factors from the units of files to SI: multiply on
/// the way in, divide on the way out.
namespace trochoid::unit {

inline constexpr double one = 1.0;
inline constexpr double turn = 2.0 * std::numbers::pi;   ///< [rad]
inline constexpr double mm = 1e-3;                       ///< [m]
inline constexpr double um = 1e-6;                       ///< [m]
inline constexpr double inch = 25.4e-3;                  ///< [m]
inline constexpr double thou = 25.4e-6;                  ///< a thousandth of it [m]
inline constexpr double deg = std::numbers::pi / 180.0;  ///< [rad]
inline constexpr double rpm = turn / 60.0;               ///< [rad/s]
inline constexpr double Hz = turn;                       ///< [rad/s]
inline constexpr double kPa = 1e3;                       ///< [N/m^2]
inline constexpr double MPa = 1e6;                       ///< [N/m^2]
inline constexpr double GPa = 1e9;                       ///< [N/m^2]
inline constexpr double N_per_mm = 1e3;                  ///< [N/m]
inline constexpr double N_per_mm3 = 1e9;                 ///< [N/m^3]
inline constexpr double mm_per_min = 1e-3 / 60.0;        ///< [m/s]
inline constexpr double Nmm = 1e-3;                      ///< [N m]

/// @brief A value in a unit of files, as it stood there if it came from one.
///
/// 30.0137 deg turned to radians and back is 30.013700000000004: the number of at most
/// 15 digits is taken if it means the same value.
double in(double value, double unit) noexcept;

}  // namespace trochoid::unit
