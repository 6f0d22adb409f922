#include <trochoid/base/units.h>
#include <trochoid/program/cycles.h>

#include <algorithm>
#include <cmath>

namespace trochoid::program {

namespace {

constexpr double clearance = 0.254 * unit::mm;
constexpr double last_sliver = 1e-9 * unit::mm;  // what rounding of sums leaves

/// Legs that lead somewhere.
struct Path {
  std::array<double, 3> place;
  std::vector<Leg>& legs;

  void to(MoveKind kind, std::array<double, 3> end) {
    if (end == place) return;
    legs.push_back({kind, end, 0.0});
    place = end;
  }
};

bool in_pecks(const Hole& hole) noexcept {
  return hole.kind == Action::peck || hole.kind == Action::chip_break;
}

}  // namespace

double pecks_of(const Hole& hole) noexcept {
  const double smallest = hole.less > 0 ? std::min(hole.peck, hole.least) : hole.peck;
  return in_pecks(hole) ? std::ceil((hole.r_level - hole.bottom) / smallest) : 1;
}

void drill(const Hole& hole, std::array<double, 3> place, std::vector<Leg>& legs) {
  Path path{place, legs};
  const auto [x, y] = hole.at;
  if (place[2] >= hole.r_level) path.to(MoveKind::rapid, {x, y, place[2]});
  path.to(MoveKind::rapid, {x, y, hole.r_level});
  if (in_pecks(hole)) {
    double peck = hole.peck;
    for (double depth = hole.r_level - peck; depth > hole.bottom + last_sliver;
         depth -= peck) {
      if (hole.less > 0) peck = std::max(peck - hole.less, std::min(peck, hole.least));
      path.to(MoveKind::line, {x, y, depth});
      if (hole.kind == Action::peck) path.to(MoveKind::rapid, {x, y, hole.r_level});
      path.to(MoveKind::rapid, {x, y, depth + clearance});
    }
  }
  path.to(MoveKind::line, {x, y, hole.bottom});
  if (hole.dwell > 0) legs.push_back({MoveKind::dwell, path.place, hole.dwell});
  path.to(MoveKind::rapid, {x, y, hole.clear});
}

}  // namespace trochoid::program
