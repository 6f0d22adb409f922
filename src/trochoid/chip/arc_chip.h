#pragma once

#include <trochoid/geometry/arcs.h>

#include <span>
#include <vector>

namespace trochoid::chip {

/// @brief An arc with the stretches of theta in which rays meet its boundaries between a
/// lower radius and the circle of the cutter.
struct ReachedArc {
  geometry::EngagedArc engaged;
  geometry::Arc at_from;  ///< [rad]
  geometry::Arc at_to;    ///< [rad]

  [[nodiscard]] double first() const noexcept { return at_from.from; }
  [[nodiscard]] double last() const noexcept { return at_to.to; }
};

/// @param lowest  radius below which nothing is cut [m]
/// @param within  theta in which there are chips at all [rad]
std::vector<ReachedArc> reached_arcs(std::span<const geometry::EngagedArc> arcs,
                                     double lowest, geometry::Arc within);

/// @brief How much of a stretch of the ray at theta is stock: the union over the arcs, each
/// clipped by its boundaries.
/// @eq N-6  h = length of [L, R_j] within the boundaries of the arcs
/// @src derived
/// @param theta  [rad], as the arcs count it
/// @return [m]
double stock_length(std::span<const ReachedArc> arcs, double theta,
                    geometry::Stretch ray) noexcept;

}  // namespace trochoid::chip
