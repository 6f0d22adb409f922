#pragma once

#include <trochoid/base/estimate.h>
#include <trochoid/geometry/cutter.h>
#include <trochoid/geometry/runout.h>

#include <array>

/// What an eccentricity means for whoever holds the dial gauge and turns the tool.
namespace trochoid::identification {

/// An eccentricity as a vector from the axis of rotation, and how well it is known.
struct Offset {
  /// rho cos(lambda), rho sin(lambda) [m]
  std::array<double, 2> e{};
  /// xx, xy, yy [m^2]
  std::array<double, 3> covariance{};

  [[nodiscard]] double amount() const noexcept;     ///< rho [m]
  [[nodiscard]] double angle() const noexcept;      ///< lambda [rad]
  [[nodiscard]] double amount_se() const noexcept;  ///< [m]
  [[nodiscard]] double angle_se() const noexcept;   ///< [rad]; infinite at rho = 0
};

/// @brief An offset by amount and angle, each with its standard error.
Offset offset_of(double rho, double lambda, double rho_se, double lambda_se) noexcept;

/// @brief The tooth that stands out farthest at a height, from 1.
/// @eq G-9 the largest R_k
/// @param z  height above the tip [m], within the profile
int longest_tooth(const geometry::Cutter& cutter, const geometry::Runout& runout,
                  double z);

/// What of an eccentricity belongs to the tool, and what to spindle and holder.
struct Separation {
  Offset holder;  ///< from tooth 1 as it stood before
  Offset tool;    ///< of its teeth about its shank, from tooth 1
  /// By which the tool is to be turned in its holder from where it is now, positive as
  /// angles of eccentricities count, so that the two parts are opposite [rad], (-pi, pi]
  double best_turn = 0.0;
  double least = 0.0;  ///< eccentricity that then remains [m]
};

/// @brief Separate the parts from two clampings of the tool in the same holder.
///
/// @eq I-22 e_1 = e_holder + e_tool, Rot e_2 = e_holder + Rot e_tool:
///          e_tool = (1 - Rot)^-1 (e_1 - Rot e_2), e_holder = e_1 - e_tool
/// @src derived
/// @param before, now  from tooth 1, the same tooth in both
/// @param turned  by which the tool was turned in its holder between them, positive as
///                angles of eccentricities count; not a multiple of 2 pi [rad]
/// @throws std::invalid_argument where it is one
Separation separate(const Offset& before, const Offset& now, double turned);

}  // namespace trochoid::identification
