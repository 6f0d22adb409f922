#pragma once

#include <trochoid/force/setup.h>
#include <trochoid/surface/error_map.h>
#include <trochoid/surface/roughness.h>

#include <optional>
#include <vector>

namespace trochoid::surface {

/// @brief Lower side of the inserts, and how the axis leans along the feed.
struct BottomEdge {
  double dish = 0.0;   ///< rise towards the axis [rad], up to pi/2
  double wiper = 0.0;  ///< flat land at the lowest point, inwards [m]
  double lead = 0.0;   ///< the axis leans forward by this [rad]
};

/// @brief Profile of the floor along the feed, at a distance from the axis across it.
///
/// @eq W-3 z(x, y) = min over teeth and turns of p(q - RAD_j) - a_j
///           - q tan(tilt) cos(psi_j - mu) - tan(lead)(x - x_c), x_c = f phi/2 pi
/// @eq W-4 q = sqrt(rho^2 - e_perp^2) - e_par, rho = |(x - x_c, y)|,
///         phi = atan2(x - x_c, y) + psi_j - atan2(e_perp, q + e_par) + 2 pi n
/// @eq W-5 p(q): outside of the lowest point the profile; inside flat over the wiper, then
///         the arc of the corner up to the dish, then rising with tan(dish)
/// @src derived
/// @param y  of the line [m], nearer to the axis than the teeth reach
/// @return one feed of a turn from where the axis is at phi = 0
PeriodicProfile floor_profile(const force::Setup& setup, const BottomEdge& bottom,
                              double y);

/// What a floor is looked at by.
struct FinishOptions {
  int samples_per_turn = 720;    ///< of the points along the feed
  std::optional<double> cutoff;  ///< of the filter [m]; none: no filter
};

/// One line of the floor.
struct FloorLine {
  double y = 0.0;  ///< [m]
  Roughness roughness;
  std::optional<Roughness> filtered;
  std::vector<double> share;  ///< of each tooth in the profile, sum 1
  std::vector<double> x;      ///< one period in even steps [m]
  std::vector<double> z;      ///< [m], shape of x
  std::vector<int> tooth;     ///< that wrote, 0-based, shape of x
};

FloorLine floor_line(const force::Setup& setup, const BottomEdge& bottom, double y,
                     const FinishOptions& options);

/// Whether the bottom of a tool is flat up to its axis.
bool is_flat(const geometry::Profile& profile, const BottomEdge& bottom);

/// @brief Profile of the wall at a height, where nothing bends: positive where material is
/// left.
///
/// @eq W-6 e(x) = min over passes of D/2 + sigma R_j cos(theta_eff), sigma = 1 down, -1 up,
///         x = f phi/2 pi + R_j sin(theta_eff), over the teeth that are there (as E-9)
/// @src derived
/// @pre the cut is up or down milling and something is fed
PeriodicProfile wall_profile(const force::Setup& setup, double height);

/// @brief Rows of a wall where nothing bends, for teeth whose edges differ.
/// @param heights  above the tip [m]
ErrorMap rigid_map(const force::Setup& setup, const std::vector<double>& heights,
                   const FinishOptions& options);

/// @brief Error and roughness of the rows of a wall where nothing bends, of the profile
/// itself: its corners are found, however few the points.
void tell_profiles(const force::Setup& setup, const FinishOptions& options,
                   ErrorMap& map);

/// @brief Roughness of the rows of a wall that bends, from its points.
/// @param length  that the points span [m]
void tell_rows(double length, const FinishOptions& options, ErrorMap& map);

}  // namespace trochoid::surface
