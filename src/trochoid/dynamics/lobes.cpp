#include <trochoid/dynamics/lobes.h>

#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

namespace trochoid::dynamics {

namespace {

/// A new speed is put in where the limit is further than this from the chord.
constexpr double worth_a_speed = 0.04;
constexpr int halvings = 3;
/// |ln |mu|| below this is near the limit.
constexpr double near_limit = 0.1;
/// The deepest cut of a diagram, far beyond the limit, may be known that much worse.
constexpr double deepest_share = 10.0;
/// Of multipliers that only say where to look further.
constexpr LobeAccuracy enough_to_look{.near = 1e-5, .far = 1e-3};

/// Work of which somebody is told.
void tell(std::size_t n, double from, double to, const LobeProgress& progress,
          const std::function<void(std::size_t)>& f) {
  std::mutex one_at_a_time;
  std::size_t done = 0;
  numerics::for_each_index(n, [&](std::size_t i) {
    f(i);
    const std::lock_guard lock(one_at_a_time);
    ++done;
    if (progress) {
      progress(from + (to - from) * static_cast<double>(done) / static_cast<double>(n));
    }
  });
}

/// Multipliers at one speed.
class Speed {
 public:
  /// @param ends  the shallowest and the deepest cut: what they need is enough for all
  Speed(const System& system, double Omega, const LobeAccuracy& accuracy,
        const std::array<const Directional*, 2>& ends)
      : system_(system), Omega_(Omega), accuracy_(accuracy) {
    const double share = accuracy.near < accuracy.far ? deepest_share : 1.0;
    factor_ =
        std::max(multiplier(*ends[0], system, Omega, accuracy.far).factor,
                 multiplier(*ends[1], system, Omega, share * accuracy.far).factor);
  }

  [[nodiscard]] std::complex<double> at(const Directional& cut) {
    const Multiplier far =
        multiplier_with(cut, system_, Omega_, factor_, 0.1 * accuracy_.far);
    const bool is_near = std::abs(std::log(std::abs(far.value))) < near_limit;
    return is_near && accuracy_.near < accuracy_.far ? near(cut) : far.value;
  }

 private:
  [[nodiscard]] std::complex<double> near(const Directional& cut) {
    const Multiplier mu =
        near_factor_ > 0
            ? multiplier_with(cut, system_, Omega_, near_factor_, 0.1 * accuracy_.near)
            : multiplier(cut, system_, Omega_, accuracy_.near);
    near_factor_ = mu.factor;
    return mu.value;
  }

  const System& system_;
  double Omega_;
  LobeAccuracy accuracy_;
  double factor_ = 1.0;
  double near_factor_ = 0.0;  ///< 0: not known yet
};

/// Between a stable and an unstable depth: chords, halved where one end stays.
Limit between(const DirectionalModel& model, const System& system, double Omega,
              std::array<double, 2> ends, double tolerance) {
  auto [lo, hi] = ends;
  const double factor =
      multiplier(model.at_depth(hi), system, Omega, 0.1 * tolerance).factor;
  Limit limit{Omega, hi, {}, 1.0};
  const auto excess = [&](double depth) {
    const Multiplier mu =
        multiplier_with(model.at_depth(depth), system, Omega, factor, 0.01 * tolerance);
    limit = {Omega, depth, mu.value, mu.factor};
    return std::log(std::abs(mu.value));
  };
  double g_lo = lo > 0 ? excess(lo) : -0.1;
  double g_hi = excess(hi);
  int kept = 0;
  for (int i = 0; i < 60 && hi - lo > tolerance * hi; ++i) {
    double x = lo - g_lo * (hi - lo) / (g_hi - g_lo);
    if (i % 4 == 3 || !(x > lo && x < hi)) {
      x = 0.5 * (lo + hi);
    }
    const double g = excess(x);
    if (std::abs(g) < 0.1 * tolerance) {
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

using Limits = std::vector<Limit>;

using LimitAt = std::function<std::optional<Limit>(double Omega)>;

/// Speeds between two, where the limit is not straight.
void add_between(const LimitAt& limit_at, const Limit& a, const Limit& b, int left,
                 Limits& out) {
  const auto middle = limit_at(0.5 * (a.Omega + b.Omega));
  if (!middle) {
    return;
  }
  const double chord = 0.5 * (a.depth + b.depth);
  if (std::abs(middle->depth - chord) <= worth_a_speed * chord) {
    return;
  }
  if (left > 1) {
    add_between(limit_at, a, *middle, left - 1, out);
  }
  out.push_back(*middle);
  if (left > 1) {
    add_between(limit_at, *middle, b, left - 1, out);
  }
}

}  // namespace

// six parameters: both axes of the diagram, and who is told how far it is
LobeGrid lobe_grid(const DirectionalModel& model, const System& system,
                   std::span<const double> Omega, std::span<const double> depth,
                   const LobeAccuracy& accuracy, const LobeProgress& progress) {
  LobeGrid grid{{Omega.begin(), Omega.end()}, {depth.begin(), depth.end()}, {}};
  grid.multiplier.resize(Omega.size() * depth.size());
  std::vector<Directional> cuts(depth.size());
  numerics::for_each_index(
      depth.size(), [&](std::size_t k) { cuts[k] = model.at_depth(grid.depth[k]); });
  tell(Omega.size(), 0.0, 1.0, progress, [&](std::size_t i) {
    Speed speed(system, grid.Omega[i], accuracy, {&cuts.front(), &cuts.back()});
    for (std::size_t k = 0; k < depth.size(); ++k) {
      grid.multiplier[i * depth.size() + k] = speed.at(cuts[k]);
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
  const Directional first = model.at_depth(depth.front());
  const Directional deepest = model.at_depth(depth.back());
  Speed speed(system, Omega, enough_to_look, {&first, &deepest});
  double stable = 0.0;
  for (const double d : depth) {
    if (std::abs(speed.at(model.at_depth(d))) > 1) {
      return between(model, system, Omega, {stable, d}, tolerance);  // D-13
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
  tell(speeds, 0.0, 0.5, progress, [&](std::size_t i) {
    for (std::size_t k = 0; k < depths; ++k) {
      if (std::abs(grid.multiplier[i * depths + k]) > 1) {
        limits[i] =
            between(model, system, grid.Omega[i],
                    {k == 0 ? 0.0 : grid.depth[k - 1], grid.depth[k]}, tolerance);
        return;
      }
    }
  });
  const LimitAt limit_at = [&](double Omega) {
    return limit_depth(model, system, Omega, grid.depth, tolerance);
  };
  std::vector<Limits> further(speeds);
  tell(speeds - 1, 0.5, 1.0, progress, [&](std::size_t i) {
    if (limits[i] && limits[i + 1]) {
      add_between(limit_at, *limits[i], *limits[i + 1], halvings, further[i]);
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
