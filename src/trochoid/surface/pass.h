#pragma once

#include <trochoid/force/setup.h>
#include <trochoid/geometry/edge.h>

#include <numbers>
#include <optional>
#include <variant>

namespace trochoid::surface {

/// @brief The finished wall, seen from the cutter.
/// @eq E-1 down: sigma = +1, theta_s = pi; up: sigma = -1, theta_s = 0. Error
///         e = -(distance of the edge beyond y = -sigma D/2), positive: material left
/// @src [wang2015] section 2; signs: docs/notation.md
struct Side {
  double sigma = 1.0;
  double theta = std::numbers::pi;  ///< where an edge touches the finished wall [rad]
};

/// The side of a pass; none for a slot or a band, which have no single finished wall.
inline std::optional<Side> side_of(const geometry::Engagement& engagement) {
  if (std::holds_alternative<geometry::DownMilling>(engagement)) {
    return Side{1.0, std::numbers::pi};
  }
  if (std::holds_alternative<geometry::UpMilling>(engagement)) {
    return Side{-1.0, 0.0};
  }
  return std::nullopt;
}

/// Radial depth of an up or a down cut, else 0 [m].
inline double radial_depth(const geometry::Engagement& engagement) {
  if (const auto* down = std::get_if<geometry::DownMilling>(&engagement)) {
    return down->a_e;
  }
  const auto* up = std::get_if<geometry::UpMilling>(&engagement);
  return up == nullptr ? 0.0 : up->a_e;
}

/// @brief One tooth at one height.
struct EdgePlace {
  double R = 0.0;       ///< from the axis of rotation [m]
  double behind = 0.0;  ///< phi - theta_eff: pitch angle, lag and turn by runout [rad]
};

/// @brief All teeth of a cylinder at one height.
/// @param height  above the tip [m]
/// @return shape (teeth)
inline std::vector<EdgePlace> edge_places(const force::Setup& setup, double height) {
  const geometry::Cutter& cutter = setup.cutter;
  const std::vector<double> psi = geometry::tooth_angles(cutter);
  const double lag = geometry::lag_at(cutter, geometry::meridian(cutter.profile),
                                      geometry::arc_length_at(
                                          geometry::meridian(cutter.profile), height))
                         .angle;
  std::vector<geometry::EdgePosition> positions(psi.size());
  geometry::edge_positions(setup.runout, psi, cutter.profile.D / 2, lag, positions);
  std::vector<EdgePlace> places;
  for (std::size_t i = 0; i < psi.size(); ++i) {
    places.push_back({positions[i].R, psi[i] + lag - positions[i].epsilon});
  }
  return places;
}

}  // namespace trochoid::surface
