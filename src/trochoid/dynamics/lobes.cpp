#include <trochoid/dynamics/lobes.h>

#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cmath>

namespace trochoid::dynamics {

namespace {

/// A new speed is put in where the limit is further than this from the chord.
constexpr double worth_a_speed = 0.04;
constexpr int halvings = 3;
/// Tolerance of multipliers that only say where to look further.
constexpr double enough_to_look = 1e-4;

/// Work in parts, so that somebody can be told about it in between.
void in_parts(std::size_t n, double from, double to, const LobeProgress& progress,
              const std::function<void(std::size_t)>& f) {
  const std::size_t part = std::max<std::size_t>(32, (n + 19) / 20);
  for (std::size_t first = 0; first < n; first += part) {
    const std::size_t count = std::min(part, n - first);
    numerics::for_each_index(count, [&](std::size_t i) { f(first + i); });
    if (progress) {
      progress(from + (to - from) * static_cast<double>(first + count) /
                          static_cast<double>(n));
    }
  }
}

class LimitSearch {
 public:
  LimitSearch(const DirectionalModel& model, const System& system, double Omega,
              double tolerance)
      : model_(model), system_(system), Omega_(Omega), tolerance_(tolerance) {}

  /// |mu| - 1, and mu kept for the answer.
  double excess(double depth) {
    last_ = multiplier(model_.at_depth(depth), system_, Omega_, 0.1 * tolerance_);
    return std::log(std::abs(last_.value));
  }

  /// Between a stable and an unstable depth: chords, halved where one end stays.
  Limit between(double lo, double hi) {
    double g_lo = lo > 0 ? excess(lo) : -0.1;
    double g_hi = excess(hi);
    Limit limit{Omega_, hi, last_.value, last_.factor};
    int kept = 0;
    for (int i = 0; i < 60 && hi - lo > tolerance_ * hi; ++i) {
      double x = lo - g_lo * (hi - lo) / (g_hi - g_lo);
      if (i % 4 == 3 || !(x > lo && x < hi)) {
        x = 0.5 * (lo + hi);
      }
      const double g = excess(x);
      limit = {Omega_, x, last_.value, last_.factor};
      if (std::abs(g) < 0.1 * tolerance_) {
        break;
      }
      if (g < 0) {
        lo = x;
        g_lo = g;
        g_hi *= kept == -1 ? 0.5 : 1.0;
        kept = -1;
      } else {
        hi = x;
        g_hi = g;
        g_lo *= kept == 1 ? 0.5 : 1.0;
        kept = 1;
      }
    }
    return limit;
  }

 private:
  const DirectionalModel& model_;
  const System& system_;
  double Omega_;
  double tolerance_;
  Multiplier last_;
};

using Limits = std::vector<Limit>;

/// Speeds between two, where the limit is not straight.
void add_between(const DirectionalModel& model, const System& system, const Limit& a,
                 const Limit& b, std::span<const double> depth, double tolerance,
                 int left, Limits& out) {
  const auto middle =
      limit_depth(model, system, 0.5 * (a.Omega + b.Omega), depth, tolerance);
  if (!middle) {
    return;
  }
  const double chord = 0.5 * (a.depth + b.depth);
  const bool bent = std::abs(middle->depth - chord) > worth_a_speed * chord;
  if (bent && left > 1) {
    add_between(model, system, a, *middle, depth, tolerance, left - 1, out);
  }
  if (bent) {
    out.push_back(*middle);
  }
  if (bent && left > 1) {
    add_between(model, system, *middle, b, depth, tolerance, left - 1, out);
  }
}

}  // namespace

LobeGrid lobe_grid(const DirectionalModel& model, const System& system,
                   std::span<const double> Omega, std::span<const double> depth,
                   double tolerance, const LobeProgress& progress) {
  LobeGrid grid{{Omega.begin(), Omega.end()}, {depth.begin(), depth.end()}, {}, {}};
  grid.multiplier.resize(Omega.size() * depth.size());
  grid.factor.resize(Omega.size());
  std::vector<Directional> cuts(depth.size());
  numerics::for_each_index(
      depth.size(), [&](std::size_t k) { cuts[k] = model.at_depth(grid.depth[k]); });
  in_parts(Omega.size(), 0.0, 1.0, progress, [&](std::size_t i) {
    const Multiplier deepest =
        multiplier(cuts.back(), system, grid.Omega[i], tolerance);
    grid.factor[i] = deepest.factor;
    for (std::size_t k = 0; k < depth.size(); ++k) {
      grid.multiplier[i * depth.size() + k] =
          k + 1 == depth.size() ? deepest.value
                                : multiplier_with(cuts[k], system, grid.Omega[i],
                                                  grid.factor[i], 0.1 * tolerance)
                                      .value;
    }
  });
  return grid;
}

std::optional<Limit> limit_depth(const DirectionalModel& model, const System& system,
                                 double Omega, std::span<const double> depth,
                                 double tolerance) {
  if (depth.empty()) {
    return std::nullopt;
  }
  const double factor =
      multiplier(model.at_depth(depth.back()), system, Omega, enough_to_look).factor;
  double stable = 0.0;
  for (const double d : depth) {
    const auto mu =
        multiplier_with(model.at_depth(d), system, Omega, factor, 0.1 * enough_to_look);
    if (std::abs(mu.value) > 1) {
      return LimitSearch(model, system, Omega, tolerance).between(stable, d);  // D-13
    }
    stable = d;
  }
  return std::nullopt;
}

std::vector<Limit> limit_curve(const DirectionalModel& model, const System& system,
                               const LobeGrid& grid, double tolerance,
                               const LobeProgress& progress) {
  const std::size_t speeds = grid.Omega.size();
  const std::size_t depths = grid.depth.size();
  std::vector<std::optional<Limit>> limits(speeds);
  in_parts(speeds, 0.0, 0.5, progress, [&](std::size_t i) {
    for (std::size_t k = 0; k < depths; ++k) {
      if (std::abs(grid.multiplier[i * depths + k]) > 1) {
        limits[i] = LimitSearch(model, system, grid.Omega[i], tolerance)
                        .between(k == 0 ? 0.0 : grid.depth[k - 1], grid.depth[k]);
        return;
      }
    }
  });
  std::vector<Limits> further(speeds);
  in_parts(speeds - 1, 0.5, 1.0, progress, [&](std::size_t i) {
    if (limits[i] && limits[i + 1]) {
      add_between(model, system, *limits[i], *limits[i + 1], grid.depth, tolerance,
                  halvings, further[i]);
    }
  });
  Limits curve;
  for (std::size_t i = 0; i < speeds; ++i) {
    if (limits[i]) {
      curve.push_back(*limits[i]);
    }
    curve.insert(curve.end(), further[i].begin(), further[i].end());
  }
  return curve;
}

}  // namespace trochoid::dynamics
