#include <trochoid/dynamics/lobes.h>

#include <trochoid/dynamics/directional.h>
#include <trochoid/dynamics/multiplier.h>
#include <trochoid/dynamics/period_map.h>
#include <trochoid/dynamics/system.h>
#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <span>
#include <vector>

namespace trochoid::dynamics {
namespace {

/// A cut at the depths of a diagram, for every speed of it.
struct Cuts {
  const DirectionalModel& model;
  std::vector<double> depth;          ///< [m], ascending
  std::vector<Directional> at_depth;  ///< empty where the cut is proportional to it
};

Cuts cuts_at(const DirectionalModel& model, std::span<const double> depth);

/// @brief Multipliers at one speed for one depth after another: what does not depend on
/// the depth is made once.
class DepthSweep {
 public:
  DepthSweep(const Cuts& cuts, const System& system, double Omega)
      : cuts_(cuts), system_(system), Omega_(Omega) {}

  /// @param depth      [m], positive
  /// @param tolerance  of the eigenvalue only
  [[nodiscard]] Multiplier at(double depth, double factor, double tolerance);
  /// @param tolerance  of |mu|, relative where it is above 1
  [[nodiscard]] Multiplier checked(double depth, double tolerance);
  [[nodiscard]] double spindle_speed() const noexcept { return Omega_; }

 private:
  const Cuts& cuts_;
  const System& system_;
  double Omega_;
  std::map<double, int> steps_;       ///< that the last search took, by factor
  std::map<double, PeriodMap> maps_;  ///< by factor, of a cut one metre deep
};

Cuts cuts_at(const DirectionalModel& model, std::span<const double> depth) {
  Cuts cuts{model, {depth.begin(), depth.end()}, {}};
  if (!model.proportional()) {
    cuts.at_depth.resize(depth.size());
    numerics::for_each_index(depth.size(), [&](std::size_t k) {
      cuts.at_depth[k] = model.at_depth(depth[k]);
    });
  }
  return cuts;
}

Multiplier DepthSweep::at(double depth, double factor, double tolerance) {
  int& steps = steps_[factor];
  const auto found = [&](PeriodMap& map) {
    const Multiplier mu = multiplier_of(map, factor, tolerance, steps);
    steps = mu.steps;
    return mu;
  };
  if (cuts_.model.proportional()) {
    auto known = maps_.find(factor);
    if (known == maps_.end()) {
      PeriodMap map(cuts_.model.at_depth(1.0), system_, Omega_, {.factor = factor});
      known = maps_.emplace(factor, std::move(map)).first;
    }
    known->second.scale_forces(depth);
    return found(known->second);
  }
  const auto known = std::find(cuts_.depth.begin(), cuts_.depth.end(), depth);
  const auto k = static_cast<std::size_t>(known - cuts_.depth.begin());
  const bool at_hand = k < cuts_.at_depth.size();
  PeriodMap map(at_hand ? cuts_.at_depth[k] : cuts_.model.at_depth(depth), system_,
                Omega_, {.factor = factor});
  return found(map);
}

Multiplier DepthSweep::checked(double depth, double tolerance) {
  return settled([&](double factor) { return at(depth, factor, 0.1 * tolerance); },
                 tolerance);
}

/// A new speed is put in where the limit is further than this from the chord.
constexpr double worth_a_speed = 0.04;
constexpr int halvings = 3;
/// |ln |mu|| below this is near the limit.
constexpr double near_limit = 0.1;
/// The deepest cut of a diagram, far beyond the limit, may be known that much worse.
constexpr double deepest_share = 10.0;
/// Of multipliers that only say where to look further, and of |ln |mu|| below which the
/// better one of the two is needed.
constexpr LobeAccuracy enough_to_look{.near = 1e-5, .far = 1e-3};
constexpr double doubtful = 5e-3;
/// Of the nodes a limit is searched with first.
constexpr double first_factor = 0.8;

/// Indices below n, those far apart first: every 16th, those between them, ...
std::vector<std::size_t> far_apart_first(std::size_t n) {
  constexpr std::size_t widest = 16;
  std::vector<std::size_t> order;
  for (std::size_t step = widest; step > 0; step /= 2) {
    const bool first = step == widest;
    for (std::size_t i = first ? 0 : step; i < n; i += first ? step : 2 * step) {
      order.push_back(i);
    }
  }
  return order;
}

/// From one part of the work to the next.
struct Share {
  double from = 0.0;
  double to = 1.0;
};

/// Work that is watched, and ends when it is asked to.
/// @return what was done, shape (n)
std::vector<char> watched(std::size_t n, const Share& share, const LobeWatch& watch,
                          const std::function<void(std::size_t)>& f) {
  const std::vector<std::size_t> order = far_apart_first(n);
  std::vector<char> done(n, 0);
  std::mutex one_at_a_time;
  std::size_t count = 0;
  std::atomic<std::size_t> next = 0;
  numerics::for_each_index(n, [&](std::size_t) {
    if (watch.stop.wanted()) {
      return;
    }
    const std::size_t i = order[next++];
    f(i);
    const std::lock_guard lock(one_at_a_time);
    done[i] = 1;
    ++count;
    if (watch.progress) {
      watch.progress(share.from + (share.to - share.from) * static_cast<double>(count) /
                                      static_cast<double>(n));
    }
  });
  return done;
}

/// Multipliers at one speed.
class Speed {
 public:
  /// What the shallowest and the deepest cut need is enough for all.
  Speed(const Cuts& cuts, const System& system, double Omega,
        const LobeAccuracy& accuracy)
      : sweep_(cuts, system, Omega), accuracy_(accuracy) {
    const double share = accuracy.near < accuracy.far ? deepest_share : 1.0;
    factor_ = std::max(sweep_.checked(cuts.depth.front(), accuracy.far).factor,
                       sweep_.checked(cuts.depth.back(), share * accuracy.far).factor);
  }

  /// @param within  of |ln |mu||, where |mu| is to be known better
  [[nodiscard]] std::complex<double> at(double depth, double within) {
    const Multiplier far = sweep_.at(depth, factor_, 0.1 * accuracy_.far);
    const bool is_near = std::abs(std::log(std::abs(far.value))) < within;
    return is_near && accuracy_.near < accuracy_.far ? near(depth) : far.value;
  }

  [[nodiscard]] DepthSweep& sweep() noexcept { return sweep_; }

 private:
  [[nodiscard]] std::complex<double> near(double depth) {
    const Multiplier mu = near_factor_ > 0
                              ? sweep_.at(depth, near_factor_, 0.1 * accuracy_.near)
                              : sweep_.checked(depth, accuracy_.near);
    near_factor_ = mu.factor;
    return mu.value;
  }

  DepthSweep sweep_;
  LobeAccuracy accuracy_;
  double factor_ = 1.0;
  double near_factor_ = 0.0;  ///< 0: not known yet
};

/// A depth and ln |mu| there.
struct Tried {
  double depth = 0.0;  ///< [m]
  double g = 0.0;
};

/// A stable depth and an unstable one.
struct Bracket {
  Tried stable{0.0, -0.1};  ///< depth 0: some damping
  Tried unstable;
};

/// The root of g between two depths: inverse quadratic interpolation where three points
/// allow it, else halves (Chandrupatla).
Limit root(DepthSweep& sweep, const Bracket& bracket, double factor, double tolerance) {
  Tried a = bracket.unstable;  // the newest
  Tried b = bracket.stable;    // on the other side
  double t = a.g / (a.g - b.g);
  Limit limit;
  for (int i = 0; i < 60; ++i) {
    const double least = 0.5 * tolerance * a.depth / std::abs(b.depth - a.depth);
    const double part = std::clamp(t, std::min(0.5, least), std::max(0.5, 1 - least));
    const double depth = a.depth + part * (b.depth - a.depth);
    const Multiplier mu = sweep.at(depth, factor, 0.01 * tolerance);
    const Tried x{depth, std::log(std::abs(mu.value))};
    limit = {sweep.spindle_speed(), depth, mu.value, factor, mu.error};
    Tried c = a;
    if ((x.g > 0) != (a.g > 0)) {
      c = b;
      b = a;
    }
    a = x;
    if (std::abs(a.g) < 0.1 * tolerance ||
        std::abs(b.depth - a.depth) <= tolerance * a.depth) {
      break;
    }
    const double xi = (a.depth - b.depth) / (c.depth - b.depth);
    const double phi = (a.g - b.g) / (c.g - b.g);
    const bool smooth = phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi;
    t = smooth ? a.g / (b.g - a.g) * c.g / (b.g - c.g) +
                     (c.depth - a.depth) / (b.depth - a.depth) * a.g / (c.g - a.g) *
                         b.g / (c.g - b.g)
               : 0.5;
  }
  return limit;
}

/// How far |mu| at a limit is from that of more nodes.
double error_of(DepthSweep& sweep, const Limit& limit, double tolerance) {
  if (limit.error > 0) {
    return limit.error;
  }
  const Multiplier finer =
      sweep.at(limit.depth, more_nodes * limit.factor, 0.01 * tolerance);
  return std::abs(std::abs(finer.value) - std::abs(limit.multiplier));
}

/// The limit between two depths, with nodes added until more of them agree.
Limit limit_between(DepthSweep& sweep, const Bracket& bracket, double factor,
                    double tolerance) {
  constexpr double most = 4.0;
  while (true) {
    const Limit found = root(sweep, bracket, factor, tolerance);
    factor *= more_nodes;
    if (factor > most || error_of(sweep, found, tolerance) <= 0.3 * tolerance) {
      return found;
    }
  }
}

/// ln |mu| with its sign right, unless it is nothing.
double looked_at(DepthSweep& sweep, double depth, double factor) {
  const double g =
      std::log(std::abs(sweep.at(depth, factor, 0.1 * enough_to_look.far).value));
  return std::abs(g) > doubtful
             ? g
             : std::log(
                   std::abs(sweep.at(depth, factor, 0.1 * enough_to_look.near).value));
}

/// The step of the depths in which the cut becomes unstable, searched from a depth.
std::optional<Bracket> bracket_from(DepthSweep& sweep, const std::vector<double>& depth,
                                    double from, double factor) {
  const auto above = std::upper_bound(depth.begin(), depth.end(), from);
  auto k =
      static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - depth.begin(), 1)) - 1;
  Tried here{depth[k], looked_at(sweep, depth[k], factor)};
  while (here.g > 0) {
    if (k == 0) {
      return Bracket{.unstable = here};
    }
    --k;
    const Tried below{depth[k], looked_at(sweep, depth[k], factor)};
    if (below.g <= 0) {
      return Bracket{below, here};
    }
    here = below;
  }
  while (++k < depth.size()) {
    const Tried deeper{depth[k], looked_at(sweep, depth[k], factor)};
    if (deeper.g > 0) {
      return Bracket{here, deeper};
    }
    here = deeper;
  }
  return std::nullopt;
}

using Limits = std::vector<Limit>;

/// The limit at a speed between two others.
using LimitAt =
    std::function<std::optional<Limit>(double Omega, const Limit& a, const Limit& b)>;

/// Speeds between two, where the limit is not straight.
void add_between(const LimitAt& limit_at, const Limit& a, const Limit& b, int left,
                 Limits& out) {
  const auto middle = limit_at(0.5 * (a.Omega + b.Omega), a, b);
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

/// The limit at a speed of a grid.
std::optional<Limit> limit_of(const Cuts& cuts, const System& system,
                              const LobeGrid& grid, std::size_t i, double tolerance) {
  const std::size_t depths = grid.depth.size();
  const auto tried = [&](std::size_t k) {
    return Tried{grid.depth[k], std::log(std::abs(grid.multiplier[i * depths + k]))};
  };
  for (std::size_t k = 0; k < depths; ++k) {
    if (tried(k).g > 0) {
      DepthSweep sweep(cuts, system, grid.Omega[i]);
      Bracket bracket{.unstable = tried(k)};
      if (k > 0) {
        bracket.stable = tried(k - 1);
      }
      return limit_between(sweep, bracket, first_factor, tolerance);  // D-13
    }
  }
  return std::nullopt;
}

}  // namespace

// six parameters: both axes of the diagram, and who looks at the work
LobeGrid lobe_grid(const DirectionalModel& model, const System& system,
                   std::span<const double> Omega, std::span<const double> depth,
                   const LobeAccuracy& accuracy, const LobeWatch& watch) {
  std::vector<std::vector<std::complex<double>>> columns(Omega.size());
  const Cuts cuts = cuts_at(model, depth);
  const auto done = watched(Omega.size(), {}, watch, [&](std::size_t i) {
    Speed speed(cuts, system, Omega[i], accuracy);
    for (const double d : depth) {
      columns[i].push_back(speed.at(d, near_limit));
    }
  });
  LobeGrid grid{{}, {depth.begin(), depth.end()}, {}, cuts.at_depth};
  for (std::size_t i = 0; i < Omega.size(); ++i) {
    if (done[i] != 0) {
      grid.Omega.push_back(Omega[i]);
      grid.multiplier.insert(grid.multiplier.end(), columns[i].begin(),
                             columns[i].end());
    }
  }
  return grid;
}

std::optional<Limit> limit_depth(const DirectionalModel& model, const System& system,
                                 double Omega, std::span<const double> depth,
                                 double tolerance) {
  if (depth.empty()) {
    return std::nullopt;
  }
  const Cuts cuts{model, {depth.front(), depth.back()}, {}};
  Speed speed(cuts, system, Omega, enough_to_look);
  Bracket bracket;
  for (const double d : depth) {
    const double g = std::log(std::abs(speed.at(d, doubtful)));
    if (g > 0) {
      bracket.unstable = {d, g};
      return limit_between(speed.sweep(), bracket, first_factor, tolerance);  // D-13
    }
    bracket.stable = {d, g};
  }
  return std::nullopt;
}

std::vector<Limit> limit_curve(const DirectionalModel& model, const System& system,
                               const LobeGrid& grid, double tolerance,
                               const LobeWatch& watch) {
  const std::size_t speeds = grid.Omega.size();
  if (speeds == 0) {
    return {};
  }
  const Cuts cuts{model, grid.depth, grid.at_depth};
  std::vector<std::optional<Limit>> limits(speeds);
  constexpr double half = 0.5;
  watched(speeds, {0.0, half}, watch, [&](std::size_t i) {
    limits[i] = limit_of(cuts, system, grid, i, tolerance);
  });
  const LimitAt limit_at = [&](double Omega, const Limit& a,
                               const Limit& b) -> std::optional<Limit> {
    DepthSweep sweep(cuts, system, Omega);
    const double factor = std::max(a.factor, b.factor);
    const auto bracket =
        bracket_from(sweep, cuts.depth, std::min(a.depth, b.depth), factor);
    if (!bracket) {
      return std::nullopt;
    }
    return limit_between(sweep, *bracket, factor, tolerance);
  };
  std::vector<Limits> further(speeds);
  watched(speeds - 1, {half, 1.0}, watch, [&](std::size_t i) {
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
