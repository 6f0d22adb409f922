#pragma once

#include <limits>
#include <span>
#include <vector>

namespace trochoid::geometry {

/// An arc of theta [rad].
struct Arc {
  double from = 0.0;
  double to = 0.0;
};

/// @brief What bounds the stock at the end of an arc: a line or a circle in the plane of a
/// slice, seen from the axis of the cutter, feed along +x.
struct StockBoundary {
  enum class Kind {
    none,     ///< the arc ends at all radii alike
    line,     ///< stock where r cos(theta - beta) > distance
    outside,  ///< stock outside the circle
    inside,   ///< stock inside the circle
  };
  Kind kind = Kind::none;
  double beta = 0.0;      ///< direction of the normal, or of the centre [rad]
  double distance = 0.0;  ///< of the line, or of the centre [m]
  double radius = 0.0;    ///< of the circle [m]
};

/// Stretch of a ray [m].
struct Stretch {
  double from = 0.0;
  double to = 0.0;
};

/// @brief The part of a stretch of the ray at theta that is on the side of the stock.
///
/// Of two parts the outer one.
/// @eq N-5  r_b = distance/cos(theta - beta)  (line),
///          D cos(theta - beta) +- sqrt(R^2 - D^2 sin^2(theta - beta))  (circle)
/// @src derived
Stretch clipped(const StockBoundary& boundary, double theta, Stretch ray) noexcept;

/// @brief Where a boundary that crosses the circle of the cutter at theta crosses another
/// radius r.
/// @return theta [rad] next to the one given; where it does not get there, the place where
///         it comes back to the circle
double theta_at_radius(const StockBoundary& boundary, double theta, double r) noexcept;

/// Stock on an arc of the circle of the cutter.
struct EngagedArc {
  Arc arc;  ///< theta at the radius of the longest tooth [rad]
  StockBoundary at_from = {};
  StockBoundary at_to = {};
};

/// Arcs between two heights above the tip.
struct ArcLayer {
  double from = 0.0;                                    ///< [m]
  double to = std::numeric_limits<double>::infinity();  ///< [m]
  std::vector<EngagedArc> arcs;                         ///< ascending
};

/// @brief Stock on arcs of theta, which something else has found.
struct Arcs {
  std::vector<ArcLayer> layers;  ///< ascending, none above another
  double curvature = 0.0;        ///< of the path, positive to the left [1/m]

  /// Arcs at a height above the tip [m]; an end between two layers is that of the upper.
  [[nodiscard]] std::span<const EngagedArc> at(double height) const noexcept;
};

}  // namespace trochoid::geometry
