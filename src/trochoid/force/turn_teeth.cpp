#include <trochoid/force/turn_teeth.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/geometry/edge.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::force {

namespace {

/// Largest sin(theta) within the stock: how much of the feed a chip can be.
double largest_sine(const geometry::Band& stock, double r) noexcept {
  const double lowest = std::clamp(stock.y_lo / r, -1.0, 1.0);
  const double highest = std::clamp(stock.y_hi / r, -1.0, 1.0);
  const double c =
      lowest > 0 ? lowest : std::min(highest, 0.0);  // nearest to the front
  return std::sqrt(std::max(1 - c * c, 1e-12));
}

}  // namespace

std::optional<TurnTeeth> turn_teeth(const Setup& setup, double tolerance) {
  if (!keeps_radius(setup) || !(setup.cut.f_z > 0) ||
      std::holds_alternative<geometry::Arcs>(setup.cut.engagement)) {
    return std::nullopt;
  }
  TurnTeeth out{.passage = chip::passage(setup.cutter, setup.cut, setup.chip),
                .r = setup.cutter.profile.D / 2,
                .behind = geometry::tooth_angles(setup.cutter),
                .a_p = setup.cut.a_p};
  const double lag_per_height =
      2 * std::tan(setup.cutter.helix) / setup.cutter.lag_diameter;
  out.lag = lag_per_height * out.a_p;
  if (setup.edge_length == EdgeLength::true_length) {
    out.edge_factor = std::hypot(1.0, out.r * lag_per_height);
  }
  out.teeth.resize(out.behind.size());
  geometry::edge_positions(runout_of(setup), out.behind, out.r, 0.0, out.teeth);
  for (const geometry::EdgePosition& tooth : out.teeth) {
    if (!(tooth.R > 0)) {
      return std::nullopt;
    }
  }
  const double f_z = out.passage.feed * unit::turn / out.passage.teeth;
  // The edge force grows within a lag: there an angle counts for 1/lag of the chip.
  const double allowed = tolerance * std::clamp(2 * out.lag, 1e-4, 1.0) * f_z *
                         largest_sine(out.passage.stock, out.r);
  const std::size_t different = teeth_alike(setup) ? 1 : out.teeth.size();
  out.harmonics.reserve(different);
  for (std::size_t j = 0; j < different; ++j) {
    auto harmonics =
        chip::tooth_harmonics(out.passage, out.slice(), static_cast<int>(j), allowed);
    if (!harmonics) {
      return std::nullopt;
    }
    out.harmonics.push_back(std::move(*harmonics));
  }
  for (std::size_t j = 0; j < out.behind.size(); ++j) {
    out.behind[j] -= out.teeth[j].epsilon;
  }
  return out;
}

}  // namespace trochoid::force
