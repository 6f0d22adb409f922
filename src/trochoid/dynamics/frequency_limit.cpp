#include <trochoid/dynamics/frequency_limit.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/depth_harmonics.h>
#include <trochoid/dynamics/regenerative_loop.h>
#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

namespace trochoid::dynamics {

namespace {

using Complex = std::complex<double>;

/// Steps of the scan while the longest delay turns once.
constexpr double steps_per_wave = 48.0;
/// Both neighbours of a crossing must be there: eigenvalues down to this fraction of the
/// one looked for are kept.
constexpr double kept_beside = 0.5;
/// Of the root in omega.
constexpr int refinements = 12;

Complex nearest(const std::vector<Complex>& values, Complex to) {
  return *std::min_element(values.begin(), values.end(), [&](Complex a, Complex b) {
    return std::abs(a - to) < std::abs(b - to);
  });
}

/// An eigenvalue at a frequency.
struct Point {
  double omega = 0.0;
  Complex lambda;
};

/// Where the eigenvalue is real between two frequencies: false position, halved where
/// one end stays (Illinois).
Point real_between(const RegenerativeLoop& loop, Point a, Point b) {
  double weight_a = a.lambda.imag();
  double weight_b = b.lambda.imag();
  Point found = std::abs(weight_a) < std::abs(weight_b) ? a : b;
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

/// The onset that an eigenvalue passes through from one frequency to the next.
void take_crossings(const RegenerativeLoop& loop, double from,
                    const std::vector<Complex>& before, const Point& after,
                    Onset& best) {
  const Complex start = nearest(before, after.lambda);
  const bool crosses = (start.imag() > 0) != (after.lambda.imag() > 0);
  const double larger = std::max(start.real(), after.lambda.real());
  if (!crosses || larger * best.factor < 1) {
    return;
  }
  const Point real = real_between(loop, {from, start}, after);
  if (real.lambda.real() * best.factor > 1) {
    best = {1 / real.lambda.real(), real.omega};  // D-23
  }
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

/// The onset of a cut of some depth, up to a factor.
using OnsetAt = std::function<std::optional<Onset>(double depth, double most)>;

/// A depth, and the logarithm of the factor to the onset: negative where unstable.
struct Tried {
  double depth = 0.0;
  double g = 0.0;
  double omega = 0.0;
};

/// No factor is looked for beyond this: it is searched from a depth nearer by.
constexpr double far_enough = 4.0;
/// Of the way to where a cut would become unstable if its force were proportional to the
/// depth, in logarithms: the next depth looked at.
constexpr double next_look = 0.75;

Tried tried(const OnsetAt& at, double depth, double most) {
  const auto found = at(depth, most);
  return found ? Tried{depth, std::log(found->factor), found->omega}
               : Tried{depth, std::log(most), 0.0};
}

/// Between a stable depth and an unstable one: false position over the logarithm of the
/// depth (Illinois).
FrequencyLimit limit_between(const OnsetAt& at, double Omega, Tried stable,
                             Tried unstable, double tolerance) {
  double weight_stable = stable.g;
  double weight_unstable = unstable.g;
  while (unstable.depth - stable.depth > tolerance * unstable.depth &&
         unstable.g < -0.1 * tolerance) {
    const double t = weight_stable / (weight_stable - weight_unstable);
    const double ratio = unstable.depth / stable.depth;
    const Tried middle = tried(
        at, stable.depth * std::pow(ratio, std::clamp(t, 0.02, 0.98)), far_enough);
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
  return {Omega, unstable.depth, unstable.omega};  // D-24
}

/// The limit of a cut whose force is not proportional to the depth, on the depths given.
std::optional<FrequencyLimit> searched(const OnsetAt& at, double Omega,
                                       std::span<const double> depth,
                                       double tolerance) {
  Tried stable{1e-3 * depth.front(), std::log(1e3)};
  std::size_t k = 0;
  while (k < depth.size()) {
    const Tried here = tried(at, depth[k], far_enough);
    if (here.g <= 0) {
      return limit_between(at, Omega, stable, here, tolerance);
    }
    stable = here;
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
    const auto at = [&](double a_p, double most) {
      return onset(forces.at(a_p), point, Omega, h, most);
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
  const RegenerativeLoop loop(forces, point, Omega, h);
  const Band band = band_of(point);
  const double longest = forces.delays.empty() ? forces.period : forces.delays.back();
  const double step =
      std::min(std::max(line_distance(point), narrowest_peak(point) / 5),
               unit::turn * Omega / longest / steps_per_wave);
  const auto steps = static_cast<std::size_t>(std::ceil((band.to - band.from) / step));
  Onset best{.factor = most};
  std::vector<Complex> before;
  double last = band.from;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double omega = std::min(band.from + step * static_cast<double>(i), band.to);
    std::vector<Complex> now = loop.eigenvalues(omega, kept_beside / best.factor);
    if (!before.empty()) {
      for (const Complex& lambda : now) {
        take_crossings(loop, last, before, {omega, lambda}, best);
      }
    }
    before = std::move(now);
    last = omega;
  }
  return best.factor < most ? std::optional(best) : std::nullopt;
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
