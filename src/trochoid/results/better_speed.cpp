#include <trochoid/results/better_speed.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <iterator>
#include <vector>

namespace trochoid::results {

namespace {

using dynamics::Stability;

/// Speeds up to this fraction off that of the case are near.
constexpr double near_speed = 0.3;
/// Worth a change of speed: so many times the limit.
constexpr double worth_it = 1.2;

/// Limits of the diagram by speed; where every depth is stable, its greatest.
std::vector<BetterSpeed> limits_by_speed(const StabilityResult& r) {
  std::vector<BetterSpeed> curve;
  for (const dynamics::LimitPoint& point : judged_curve(r)) {
    curve.push_back({point.limit.Omega, point.limit.depth});
  }
  if (curve.empty() && !r.by_modes()) return curve;
  const std::vector<BetterSpeed> limited = curve;
  const Stability& s = r.stability;
  const std::size_t depths = s.lobes.depth.size();
  const auto is_stable = [&](std::size_t i) {
    if (!r.by_modes()) {
      return std::ranges::none_of(limited, [&](const BetterSpeed& one) {
        return one.Omega == r.problem.spindle_speeds[i];
      });
    }
    const auto row =
        s.lobes.multiplier.begin() + static_cast<std::ptrdiff_t>(i * depths);
    return std::all_of(row, row + static_cast<std::ptrdiff_t>(depths),
                       [](const std::complex<double>& mu) { return std::abs(mu) < 1; });
  };
  const std::vector<double>& speeds =
      r.by_modes() ? s.lobes.Omega : r.problem.spindle_speeds;
  const double greatest =
      r.by_modes() && depths > 0 ? s.lobes.depth.back() : judged_to(r);
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    if (is_stable(i)) curve.push_back({speeds[i], greatest});
  }
  std::ranges::sort(curve, {}, &BetterSpeed::Omega);
  return curve;
}

/// The limit at a speed of the diagram, straight between two of its points.
double limit_at(const std::vector<BetterSpeed>& curve, double Omega) {
  const auto after = std::ranges::upper_bound(curve, Omega, {}, &BetterSpeed::Omega);
  if (after == curve.begin()) return curve.front().depth;
  if (after == curve.end()) return curve.back().depth;
  const BetterSpeed& before = *std::prev(after);
  const double part = (Omega - before.Omega) / (after->Omega - before.Omega);
  return before.depth + part * (after->depth - before.depth);
}

/// The least limit while the spindle is off by up to speed_slack.
double least_near(const std::vector<BetterSpeed>& curve, double Omega) {
  const double slowest = (1 - speed_slack) * Omega;
  const double fastest = (1 + speed_slack) * Omega;
  double least = std::min(limit_at(curve, slowest), limit_at(curve, fastest));
  for (const BetterSpeed& one : curve) {
    if (one.Omega >= slowest && one.Omega <= fastest) {
      least = std::min(least, one.depth);
    }
  }
  return least;
}

}  // namespace

std::optional<double> limit_of_a_spindle(const StabilityResult& r) {
  const auto limit = judged_limit(r);
  const auto curve = limits_by_speed(r);
  const double here = r.problem.setup.cut.Omega;
  if (!limit || !r.stability.whole || curve.size() < 2 || here < curve.front().Omega ||
      here > curve.back().Omega) {
    return std::nullopt;
  }
  return std::min(least_near(curve, here), *limit);
}

std::optional<BetterSpeed> better_speed(const StabilityResult& r) {
  const auto limit = judged_limit(r);
  if (!limit || !r.stability.whole) {
    return std::nullopt;
  }
  const auto curve = limits_by_speed(r);
  const double here = r.problem.setup.cut.Omega;
  std::optional<BetterSpeed> best;
  for (const BetterSpeed& one : curve) {
    const bool known = (1 - speed_slack) * one.Omega >= curve.front().Omega &&
                       (1 + speed_slack) * one.Omega <= curve.back().Omega;
    if (!known || std::abs(one.Omega / here - 1) > near_speed) continue;
    const double worst = least_near(curve, one.Omega);
    if (!best || worst > best->depth) {
      best = {one.Omega, worst};
    }
  }
  const double now = limit_of_a_spindle(r).value_or(*limit);
  return best && best->depth > worth_it * now ? best : std::nullopt;
}

std::optional<SpeedRange> speeds_looked_at(const StabilityResult& r) {
  const auto curve = limits_by_speed(r);
  if (curve.size() < 2) {
    return std::nullopt;
  }
  const double here = r.problem.setup.cut.Omega;
  const SpeedRange range{
      std::max(curve.front().Omega / (1 - speed_slack), (1 - near_speed) * here),
      std::min(curve.back().Omega / (1 + speed_slack), (1 + near_speed) * here)};
  return range.from < range.to ? std::optional(range) : std::nullopt;
}

}  // namespace trochoid::results
