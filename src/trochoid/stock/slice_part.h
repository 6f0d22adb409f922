#pragma once

#include <trochoid/stock/wall.h>

#include <array>
#include <cstddef>

namespace trochoid::stock {

/// A point of a slice, in the frame of a cutter [m].
using SlicePoint = std::array<double, 2>;

/// @brief What a piece of the path has swept at a height: a capsule, or a sector of a ring,
/// and on a slope of a tool that is not flat the union of discs that grow along a line.
struct SlicePart {
  double R = 0.0;       ///< of the disc, the largest on a slope [m]
  double radius = 0.0;  ///< of the path; 0: straight [m]
  SlicePoint center{};  ///< of an arc [m]
  double start = 0.0;   ///< of an arc, angle about its centre [rad]
  double turn = 0.0;    ///< of an arc [rad]
  std::array<SlicePoint, 2> end{};
  /// On a slope: the wall, the height above the tip at each end, the smallest disc.
  const Wall* wall = nullptr;
  std::array<double, 2> height{};  ///< [m]
  double smallest = 0.0;           ///< [m]

  /// On a slope: radius of the disc at an end [m].
  [[nodiscard]] double disc(std::size_t i) const noexcept {
    return (height[i] > height[1 - i]) ? R : smallest;
  }
  [[nodiscard]] bool slopes() const noexcept { return wall != nullptr; }
};

/// Whether a point is swept.
bool covers(const SlicePart& part, double x, double y) noexcept;

/// How deep a point lies in a part on a slope, and towards where.
struct Overlap {
  double depth = 0.0;   ///< radius less distance of the disc that reaches farthest [m]
  SlicePoint center{};  ///< of that disc [m]
};

/// @brief The disc that reaches farthest over a point: radius less distance is concave along
/// the line, as the tool is convex.
/// @eq N-16 depth = max over u of R_e(z - z_tip(u)) - |q - p(u)|: swept where it is positive
/// @src derived
Overlap overlap(const SlicePart& part, double x, double y) noexcept;

}  // namespace trochoid::stock
