#pragma once

#include <array>
#include <cstdint>

namespace trochoid::program {

using Point = std::array<double, 2>;

enum class ArcFault : std::uint8_t {
  none,
  radii_differ,  ///< at start and end
  no_radius,     ///< the center is the start
  radius_too_small,
  no_chord,  ///< a radius, but the end is the start
};

/// @brief An arc in its plane.
struct Arc {
  ArcFault fault = ArcFault::none;
  bool straight = false;  ///< the ends are nearer than 1 um, but are not the same
  Point center{};         ///< [m]
  double radius = 0.0;    ///< [m]
  double turn = 0.0;      ///< [rad], positive counter-clockwise
};

/// From where to where, in the first and second axis of the plane [m].
struct ArcEnds {
  Point start{};
  Point end{};
  bool clockwise = false;
  int further_turns = 0;  ///< whole ones, besides the arc
};

/// @brief The arc about a center, which is moved onto the bisector of the chord.
///
/// The radii at start and end may differ by 0.01 mm, or by a thousandth of them. Equal ends
/// are a whole circle.
Arc arc_about(const ArcEnds& ends, Point center) noexcept;

/// @brief The arc of a radius: below half a circle, above half of one if it is negative.
///
/// It may be short of half the chord by 0.005 mm, or by a thousandth of it: half a circle.
Arc arc_of_radius(const ArcEnds& ends, double radius) noexcept;

/// @brief Into how many chords an arc is cut, so that they leave it by less than 0.1 um.
double chords_of(double radius, double turn) noexcept;

}  // namespace trochoid::program
