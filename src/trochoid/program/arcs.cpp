#include <trochoid/base/units.h>
#include <trochoid/program/arcs.h>

#include <algorithm>
#include <cmath>

namespace trochoid::program {

namespace {

constexpr double nearest_ends = 1 * unit::um;
constexpr double same_ends = 1e-6 * unit::um;  // what rounding of sums leaves

double distance(Point a, Point b) noexcept {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

/// From start to end about a center, on the side that is asked for.
double turn_about(const ArcEnds& ends, Point center) noexcept {
  const double from = std::atan2(ends.start[1] - center[1], ends.start[0] - center[0]);
  const double to = std::atan2(ends.end[1] - center[1], ends.end[0] - center[0]);
  double turn = to - from;
  if (ends.clockwise) {
    while (turn >= 0) turn -= unit::turn;
    return turn - ends.further_turns * unit::turn;
  }
  while (turn <= 0) turn += unit::turn;
  return turn + ends.further_turns * unit::turn;
}

Point middle(const ArcEnds& ends) noexcept {
  return {(ends.start[0] + ends.end[0]) / 2, (ends.start[1] + ends.end[1]) / 2};
}

/// To the left of the chord, of length 1.
Point left_of(const ArcEnds& ends, double chord) noexcept {
  return {-(ends.end[1] - ends.start[1]) / chord,
          (ends.end[0] - ends.start[0]) / chord};
}

}  // namespace

Arc arc_about(const ArcEnds& ends, Point center) noexcept {
  constexpr double slack = 0.01 * unit::mm;
  constexpr double relative = 1e-3;
  const double radius = distance(ends.start, center);
  const double at_end = distance(ends.end, center);
  const double chord = distance(ends.start, ends.end);
  Arc arc;
  if (chord > same_ends && chord < nearest_ends) {
    arc.straight = true;
    return arc;
  }
  if (!(radius > 0)) {
    arc.fault = ArcFault::no_radius;
    return arc;
  }
  if (std::abs(radius - at_end) > std::max(slack, relative * radius)) {
    arc.fault = ArcFault::radii_differ;
    return arc;
  }
  if (chord <= same_ends) {
    arc.center = center;
    arc.radius = radius;
    arc.turn = (ends.clockwise ? -1 : 1) * (1 + ends.further_turns) * unit::turn;
    return arc;
  }
  const Point mid = middle(ends);
  const Point left = left_of(ends, chord);
  const double off = (center[0] - mid[0]) * left[0] + (center[1] - mid[1]) * left[1];
  arc.center = {mid[0] + off * left[0], mid[1] + off * left[1]};
  arc.radius = distance(ends.start, arc.center);
  arc.turn = turn_about(ends, arc.center);
  return arc;
}

Arc arc_of_radius(const ArcEnds& ends, double radius) noexcept {
  constexpr double slack = 0.005 * unit::mm;
  constexpr double relative = 1e-3;
  constexpr double rounding = 1e-12;
  const double chord = distance(ends.start, ends.end);
  const double size = std::abs(radius);
  Arc arc;
  if (chord <= same_ends) {
    arc.fault = ArcFault::no_chord;
    return arc;
  }
  if (chord < nearest_ends) {
    arc.straight = true;
    return arc;
  }
  if (!(size > 0) || size < chord / 2 - std::max(slack, relative * size)) {
    arc.fault = ArcFault::radius_too_small;
    return arc;
  }
  // A root would make much of what rounding leaves of a half circle.
  const bool half_circle = chord / 2 > size * (1 - rounding);
  const double off = half_circle ? 0.0 : std::sqrt(size * size - chord * chord / 4);
  const bool to_the_left = ends.clockwise == (radius < 0);
  const Point mid = middle(ends);
  const Point left = left_of(ends, chord);
  const double signed_off = to_the_left ? off : -off;
  arc.center = {mid[0] + signed_off * left[0], mid[1] + signed_off * left[1]};
  arc.radius = distance(ends.start, arc.center);
  arc.turn = turn_about(ends, arc.center);
  return arc;
}

double chords_of(double radius, double turn) noexcept {
  constexpr double tolerance = 0.1 * unit::um;
  constexpr double widest = unit::turn / 8;
  const double cosine = 1 - tolerance / radius;
  const double widest_here =
      cosine > 0 ? std::min(widest, 2 * std::acos(cosine)) : widest;
  return std::max(1.0, std::ceil(std::abs(turn) / widest_here - 1e-9));
}

}  // namespace trochoid::program
