#include <trochoid/chip/arc_chip.h>

#include <algorithm>

namespace trochoid::chip {

namespace {

/// Where rays meet the boundary at an end between `lowest` and the circle.
geometry::Arc reach(const geometry::StockBoundary& boundary, double end, double lowest,
                    geometry::Arc within) noexcept {
  const double other = geometry::theta_at_radius(boundary, end, lowest);
  const auto [a, b] = std::minmax(end, other);
  return {std::max(a, std::min(end, within.from)),
          std::min(b, std::max(end, within.to))};
}

}  // namespace

std::vector<ReachedArc> reached_arcs(std::span<const geometry::EngagedArc> arcs,
                                     double lowest, geometry::Arc within) {
  std::vector<ReachedArc> out;
  out.reserve(arcs.size());
  for (const geometry::EngagedArc& engaged : arcs) {
    out.push_back({engaged, reach(engaged.at_from, engaged.arc.from, lowest, within),
                   reach(engaged.at_to, engaged.arc.to, lowest, within)});
  }
  return out;
}

double stock_length(std::span<const ReachedArc> arcs, double theta,
                    geometry::Stretch ray) noexcept {
  double length = 0.0;
  double until = ray.from;  // of what is counted
  for (const ReachedArc& arc : arcs) {
    if (theta < arc.first() || theta > arc.last()) continue;
    if (theta > arc.at_from.to && theta < arc.at_to.from) return ray.to - ray.from;
    geometry::Stretch part = ray;
    if (theta <= arc.at_from.to) part = clipped(arc.engaged.at_from, theta, part);
    if (theta >= arc.at_to.from) part = clipped(arc.engaged.at_to, theta, part);
    part.from = std::max(part.from, until);
    if (part.to > part.from) {  // N-6
      length += part.to - part.from;
      until = part.to;
    }
  }
  return length;
}

}  // namespace trochoid::chip
