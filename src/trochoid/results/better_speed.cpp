#include <trochoid/results/better_speed.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

namespace trochoid::results {

namespace {

using dynamics::Stability;

/// Speeds up to this fraction off that of the case are near.
constexpr double near_speed = 0.3;
/// A spindle does not keep a speed better than this, nor is the peak of a lobe known.
constexpr double speed_slack = 0.02;
/// Worth a change of speed: so many times the limit.
constexpr double worth_it = 1.2;

}  // namespace

std::optional<BetterSpeed> better_speed(const StabilityResult& r) {
  const Stability& s = r.stability;
  if (!s.limit || !s.whole) {
    return std::nullopt;
  }
  std::vector<BetterSpeed> curve;
  for (const dynamics::LimitPoint& point : s.limit_curve) {
    curve.push_back({point.limit.Omega, point.limit.depth});
  }
  const std::size_t depths = s.lobes.depth.size();
  for (std::size_t i = 0; i < s.lobes.Omega.size(); ++i) {
    const auto row =
        s.lobes.multiplier.begin() + static_cast<std::ptrdiff_t>(i * depths);
    const bool stable =
        std::all_of(row, row + static_cast<std::ptrdiff_t>(depths),
                    [](const std::complex<double>& mu) { return std::abs(mu) < 1; });
    if (stable) {
      curve.push_back({s.lobes.Omega[i], s.lobes.depth.back()});
    }
  }
  const double here = r.problem.setup.cut.Omega;
  std::optional<BetterSpeed> best;
  for (const BetterSpeed& one : curve) {
    double worst = one.depth;
    for (const BetterSpeed& other : curve) {
      if (std::abs(other.Omega / one.Omega - 1) <= speed_slack) {
        worst = std::min(worst, other.depth);
      }
    }
    const double off = std::abs(one.Omega / here - 1);
    if (off <= near_speed && (!best || worst > best->depth)) {
      best = {one.Omega, worst};
    }
  }
  return best && best->depth > worth_it * s.limit->limit.depth ? best : std::nullopt;
}

}  // namespace trochoid::results
