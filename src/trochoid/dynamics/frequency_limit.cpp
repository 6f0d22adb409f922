#include <trochoid/dynamics/frequency_limit.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/force_harmonics.h>
#include <trochoid/dynamics/point_response.h>
#include <trochoid/dynamics/regenerative_loop.h>
#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <mutex>
#include <vector>

namespace trochoid::dynamics {
namespace {

using Complex = std::complex<double>;

/// Both neighbours of a crossing must be there: eigenvalues down to this fraction of the
/// one looked for are kept.
constexpr double kept_beside = 0.5;
/// Of the root in omega.
constexpr int refinements = 12;

Complex nearest(const std::vector<Complex>& values, Complex to) {
  return *std::min_element(values.begin(), values.end(), [&](Complex a, Complex b) {
    return std::norm(a - to) < std::norm(b - to);
  });
}

/// An eigenvalue at a frequency.
struct OnsetPoint {
  double omega = 0.0;
  Complex lambda;
};

/// Where the eigenvalue is real between two frequencies: false position, halved where
/// one end stays (Illinois).
OnsetPoint real_between(const RegenerativeLoop& loop, OnsetPoint a, OnsetPoint b) {
  double weight_a = a.lambda.imag();
  double weight_b = b.lambda.imag();
  OnsetPoint found = std::abs(weight_a) < std::abs(weight_b) ? a : b;
  for (int i = 0; i < refinements; ++i) {
    const double t = weight_a / (weight_a - weight_b);
    const double omega = a.omega + t * (b.omega - a.omega);
    const auto values = loop.eigenvalues(omega, 0.0);
    if (values.empty()) {
      return found;
    }
    found = {omega, nearest(values, a.lambda + t * (b.lambda - a.lambda))};
    if (std::abs(found.lambda.imag()) < 1e-12 * std::abs(found.lambda)) {
      return found;
    }
    if ((found.lambda.imag() > 0) == (a.lambda.imag() > 0)) {
      a = found;
      weight_a = found.lambda.imag();
      weight_b *= 0.5;
    } else {
      b = found;
      weight_b = found.lambda.imag();
      weight_a *= 0.5;
    }
  }
  return found;
}

/// All eigenvalues at a frequency; none where none can reach what is looked for.
struct LoopAt {
  double omega = 0.0;
  std::vector<Complex> lambda;
};

/// The onset that an eigenvalue passes through from one frequency to the next.
void take_crossings(const RegenerativeLoop& loop, const LoopAt& before,
                    const OnsetPoint& after, Onset& best) {
  const Complex start = nearest(before.lambda, after.lambda);
  const bool crosses = (start.imag() > 0) != (after.lambda.imag() > 0);
  const double larger = std::max(start.real(), after.lambda.real());
  if (!crosses || larger * best.factor < 1) {
    return;
  }
  const OnsetPoint real = real_between(loop, {before.omega, start}, after);
  if (real.lambda.real() * best.factor > 1) {
    best = {1 / real.lambda.real(), real.omega};  // D-23
  }
}

/// A branch is followed where it moves by less than this fraction of itself in a step.
constexpr double followed = 0.3;
/// A step is halved so often to get there.
constexpr int most_bisections = 6;

/// Whether each eigenvalue that could be an onset has one at the other frequency that it
/// may come from.
bool leads_on(const std::vector<Complex>& one, const std::vector<Complex>& other,
              const Onset& best) {
  return std::all_of(one.begin(), one.end(), [&](Complex lambda) {
    return std::abs(lambda) * best.factor < 1 ||
           (!other.empty() &&
            std::abs(nearest(other, lambda) - lambda) <= followed * std::abs(lambda));
  });
}

/// Every branch from one frequency to the next, in as many steps as it takes.
void follow(const RegenerativeLoop& loop, const LoopAt& a, const LoopAt& b,
            int halvings, Onset& best) {
  if (halvings > 0 &&
      !(leads_on(a.lambda, b.lambda, best) && leads_on(b.lambda, a.lambda, best))) {
    const double omega = 0.5 * (a.omega + b.omega);
    const LoopAt middle{omega, loop.eigenvalues(omega, kept_beside / best.factor)};
    follow(loop, a, middle, halvings - 1, best);
    follow(loop, middle, b, halvings - 1, best);
    return;
  }
  if (a.lambda.empty()) {
    return;
  }
  for (const Complex& lambda : b.lambda) {
    take_crossings(loop, a, {b.omega, lambda}, best);
  }
}

/// So many steps of the scan on each side of a known onset are looked at first.
constexpr std::size_t steps_beside = 3;

/// Which frequencies an onset is looked for at.
enum class Frequencies {
  all,
  beside_known,  ///< next to an onset at another depth
};

/// How an onset is looked for.
struct Look {
  double most = 1.0;  ///< greatest factor
  double known =
      0.0;  ///< an onset at a depth nearby [rad/s]; 0: none. What is found there
            ///< first spares the eigenvalues of vibrations that fade faster.
  Frequencies frequencies = Frequencies::all;
};

/// @brief The least onset of one cut.
std::optional<Onset> onset_of(const RegenerativeLoop& loop,
                              const std::vector<KeptResponse>& scan, const Look& how) {
  Onset best{.factor = how.most};
  const auto look = [&](std::size_t from, std::size_t to) {
    LoopAt before;
    for (std::size_t i = from; i <= to; ++i) {
      LoopAt now{scan[i].omega, loop.eigenvalues(scan[i], kept_beside / best.factor)};
      if (i > from) {
        follow(loop, before, now, most_bisections, best);
      }
      before = std::move(now);
    }
  };
  const auto above =
      std::ranges::lower_bound(scan, how.known, {}, &KeptResponse::omega);
  const auto here = static_cast<std::size_t>(above - scan.begin());
  const std::size_t last = scan.size() - 1;
  const std::size_t from = here > steps_beside ? here - steps_beside : 0;
  const std::size_t to = how.known > 0 ? std::min(here + steps_beside, last) : from;
  look(from, to);
  if (how.frequencies == Frequencies::all) {
    look(0, from);
    look(to, last);
  }
  return best.factor < how.most ? std::optional(best) : std::nullopt;
}

/// The strongest of the frequencies of a vibration: where the point is softest [Hz].
double strongest_frequency(const PointResponse& point, double omega, double step,
                           int h) {
  double best = omega;
  for (int k = -most_mirrored - h; h > 0 && k <= most_mirrored + h; ++k) {
    const double other = std::abs(omega + step * k);
    if (largest(receptance(point, other)) > largest(receptance(point, best))) {
      best = other;
    }
  }
  return best / unit::turn;
}

/// The onset of a cut of some depth.
using OnsetAt = std::function<std::optional<Onset>(double depth, const Look& how)>;

/// A depth, and the logarithm of the factor to the onset: negative where unstable.
struct TriedDepth {
  double depth = 0.0;
  double g = 0.0;
  double omega = 0.0;
};

/// No factor is looked for beyond this: it is searched from a depth nearer by.
constexpr double far_enough = 4.0;
/// Of the way to where a cut would become unstable if its force were proportional to the
/// depth, in logarithms: the next depth looked at.
constexpr double next_look = 0.75;

TriedDepth tried(const OnsetAt& at, double depth, const Look& how) {
  const auto found = at(depth, how);
  return found ? TriedDepth{depth, std::log(found->factor), found->omega}
               : TriedDepth{depth, std::log(how.most), 0.0};
}

/// Where one onset becomes unstable between a depth at which it is not and one at which it is:
/// false position over the logarithm of the depth (Illinois).
TriedDepth followed_down(const OnsetAt& at, TriedDepth stable, TriedDepth unstable,
                         double tolerance) {
  double weight_stable = stable.g;
  double weight_unstable = unstable.g;
  while (unstable.depth - stable.depth > tolerance * unstable.depth &&
         unstable.g < -0.1 * tolerance) {
    const double t = weight_stable / (weight_stable - weight_unstable);
    const double ratio = unstable.depth / stable.depth;
    const double depth = stable.depth * std::pow(ratio, std::clamp(t, 0.02, 0.98));
    const TriedDepth middle =
        tried(at, depth, {far_enough, unstable.omega, Frequencies::beside_known});
    if (middle.g > 0) {
      stable = middle;
      weight_stable = middle.g;
      weight_unstable *= 0.5;
    } else {
      unstable = middle;
      weight_unstable = middle.g;
      weight_stable *= 0.5;
    }
  }
  return unstable;
}

/// The least depth of an onset between a stable depth and an unstable one: one onset is
/// followed down at its own frequencies, and all are looked at where it ends.
FrequencyLimit limit_between(const OnsetAt& at, double Omega, const TriedDepth& stable,
                             TriedDepth unstable, double tolerance) {
  for (;;) {
    unstable = followed_down(at, stable, unstable, tolerance);
    const double below = unstable.depth * (1 - tolerance);
    const TriedDepth other =
        below > stable.depth ? tried(at, below, {1.0, unstable.omega}) : stable;
    if (other.g >= 0) return {Omega, unstable.depth, unstable.omega};  // D-24
    unstable = other;
  }
}

/// Followed so far beyond where an onset would be if the force were proportional to the depth.
constexpr double beyond = 1.1;

/// Where the onset of a stable depth is unstable, if that is about where it is expected.
std::optional<TriedDepth> unstable_above(const OnsetAt& at, const TriedDepth& stable,
                                         double deepest) {
  if (!(stable.omega > 0)) return std::nullopt;
  const double depth = std::min(stable.depth * std::exp(beyond * stable.g), deepest);
  const TriedDepth there =
      tried(at, depth, {far_enough, stable.omega, Frequencies::beside_known});
  return there.g <= 0 ? std::optional(there) : std::nullopt;
}

/// The limit of a cut whose force is not proportional to the depth, on the depths given.
std::optional<FrequencyLimit> searched(const OnsetAt& at, double Omega,
                                       std::span<const double> depth,
                                       double tolerance) {
  TriedDepth stable{1e-3 * depth.front(), std::log(1e3)};
  std::size_t k = 0;
  while (k < depth.size()) {
    const TriedDepth here = tried(at, depth[k], {far_enough, stable.omega});
    if (here.g <= 0) {
      return limit_between(at, Omega, stable, here, tolerance);
    }
    stable = here;
    if (const auto unstable = unstable_above(at, stable, depth.back())) {
      return limit_between(at, Omega, stable, *unstable, tolerance);
    }
    const double towards = depth[k] * std::exp(next_look * here.g);
    const auto next = std::upper_bound(depth.begin(), depth.end(), towards);
    k = std::max(k + 1, static_cast<std::size_t>(next - depth.begin()) - 1);
  }
  return std::nullopt;
}

/// The limit of a cut at one speed.
std::optional<FrequencyLimit> limit_at(const DepthHarmonics& forces,
                                       const PointResponse& point, double Omega,
                                       double tolerance) {
  const int h = forces.kept();
  std::optional<FrequencyLimit> limit;
  if (forces.proportional()) {
    const double deepest = forces.depths().back();
    const auto found = onset(forces.at(deepest), point, Omega, h, 1.0);
    if (found) {
      limit = {Omega, deepest * found->factor, found->omega};
    }
  } else {
    std::optional<ResponseAtSpeed> response;
    const auto at = [&](double a_p, const Look& how) {
      const ForceHarmonics here = forces.at(a_p);
      if (!response || !response->serves(here)) {
        response.emplace(here, point, Omega, h);
      }
      return onset_of({here, *response}, response->scan(), how);
    };
    limit = searched(at, Omega, forces.depths(), tolerance);
  }
  if (limit) {  // so far it is that of the scan [rad/s]
    const double step = unit::turn * Omega / forces.period();
    limit->chatter_frequency =
        strongest_frequency(point, limit->chatter_frequency, step, h);
  }
  return limit;
}

}  // namespace

std::optional<Onset> onset(const ForceHarmonics& forces, const PointResponse& point,
                           double Omega, int h, double most) {
  const ResponseAtSpeed response(forces, point, Omega, h);
  return onset_of({forces, response}, response.scan(), {.most = most});
}

std::optional<FrequencyLimit> frequency_limit(const DirectionalModel& model,
                                              const PointResponse& point, double Omega,
                                              std::span<const double> depth,
                                              const FrequencyOptions& options) {
  if (depth.empty()) {
    return std::nullopt;
  }
  const DepthHarmonics forces(model, depth, options.harmonics);
  return limit_at(forces, point, Omega, options.tolerance);
}

// six parameters: both axes of the diagram, and who is told how far it is
std::vector<FrequencyLimit> frequency_limits(const DirectionalModel& model,
                                             const PointResponse& point,
                                             std::span<const double> Omega,
                                             std::span<const double> depth,
                                             const FrequencyOptions& options,
                                             const FrequencyProgress& progress) {
  if (depth.empty()) {
    return {};
  }
  const DepthHarmonics forces(model, depth, options.harmonics);
  std::vector<std::optional<FrequencyLimit>> limits(Omega.size());
  std::mutex one_at_a_time;
  std::size_t done = 0;
  numerics::for_each_index(Omega.size(), [&](std::size_t i) {
    if (options.stop.wanted()) {
      return;
    }
    limits[i] = limit_at(forces, point, Omega[i], options.tolerance);
    const std::lock_guard lock(one_at_a_time);
    ++done;
    if (progress) {
      progress(static_cast<double>(done) / static_cast<double>(Omega.size()));
    }
  });
  std::vector<FrequencyLimit> curve;
  for (const auto& limit : limits) {
    if (limit) {
      curve.push_back(*limit);
    }
  }
  return curve;
}

}  // namespace trochoid::dynamics
