#include <trochoid/dynamics/frequency_limit.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/force_harmonics.h>
#include <trochoid/dynamics/point_response.h>
#include <trochoid/numerics/complex_eigenvalues.h>
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

/// Its largest entry.
double largest(const ComplexMatrix2& G) noexcept;

/// @brief What a vibration becomes by the forces that it makes: the matrix of D-22 at
/// one speed, for one frequency after another.
///
/// @eq  D-33 with process damping A_0^(k-l) + i (omega_l / Omega) D^(k-l) in D-22
/// @src derived: D-30 of a vibration, whose dq/dphi is i omega_l / Omega times q_l
class RegenerativeLoop {
 public:
  /// @param h  harmonics kept on each side; 0: the mean force
  /// @note Forces and point must outlive it.
  RegenerativeLoop(const ForceHarmonics& forces, const PointResponse& point,
                   double Omega, int h);

  /// @brief Eigenvalues at omega [rad/s].
  /// @return empty where none can reach `least`, and where another harmonic of the same
  ///         vibration is much softer
  [[nodiscard]] std::vector<std::complex<double>> eigenvalues(double omega,
                                                              double least) const;

 private:
  /// The response at the harmonics that are kept.
  struct Kept {
    std::vector<int> k;             ///< ascending
    std::vector<ComplexMatrix2> G;  ///< of each
    double softest = 0.0;           ///< largest entry of any
  };
  [[nodiscard]] Kept kept_at(double omega) const;
  void add_column(double omega, const Kept& kept, std::size_t l,
                  std::vector<std::complex<double>>& M) const;

  const ForceHarmonics& forces_;
  const PointResponse& point_;
  double Omega_;
  double step_;  ///< from a harmonic to the next [rad/s]
  int h_;
  std::vector<std::size_t> axes_;  ///< that move
  double force_size_ = 0.0;        ///< no column of forces sums up to more [N/m]
  double damping_size_ = 0.0;      ///< the same of what acts on dq/dphi [N]
};

using Complex = std::complex<double>;

/// A vibration belongs to the frequency among its harmonics at which the tool point is
/// soft; one with less than this share of the softest is left to that one.
constexpr double share_of_softest = 0.5;

double largest(const ComplexMatrix2& G) noexcept {
  double most = 0.0;
  for (const Complex& g : G) {
    most = std::max(most, std::abs(g));
  }
  return most;
}

RegenerativeLoop::RegenerativeLoop(const ForceHarmonics& forces,
                                   const PointResponse& point, double Omega, int h)
    : forces_(forces),
      point_(point),
      Omega_(Omega),
      step_(unit::turn * Omega / forces.period),
      h_(h) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const bool moves = std::any_of(
        point.parts.begin(), point.parts.end(),
        [&](const MeasuredReceptance& part) { return part.motion == axis; });
    if (moves) {
      axes_.push_back(axis);
    }
  }
  for (const auto& of_delay : forces.coefficients) {
    for (const ComplexMatrix2& coefficient : of_delay) {
      force_size_ += 2 * largest(coefficient);
    }
  }
  for (const ComplexMatrix2& coefficient : forces.damping) {
    damping_size_ += 2 * largest(coefficient);
  }
}

std::vector<Complex> RegenerativeLoop::eigenvalues(double omega, double least) const {
  const Kept kept = kept_at(omega);
  const auto fastest =
      static_cast<double>(std::max(std::abs(kept.k.front()), std::abs(kept.k.back())));
  const double force_size =
      force_size_ + damping_size_ * (omega + step_ * fastest) / Omega_;
  if (largest(receptance(point_, omega)) < share_of_softest * kept.softest ||
      2 * kept.softest * force_size < least) {
    return {};
  }
  const std::size_t n = axes_.size() * kept.k.size();
  std::vector<Complex> M(n * n);
  for (std::size_t l = 0; l < kept.k.size(); ++l) {
    add_column(omega, kept, l, M);
  }
  return least > 0 && numerics::eigenvalue_bound(M, n) < least
             ? std::vector<Complex>{}
             : numerics::complex_eigenvalues(M, n);
}

RegenerativeLoop::Kept RegenerativeLoop::kept_at(double omega) const {
  Kept kept;
  const int mirror = -static_cast<int>(std::lround(2 * omega / step_));
  if (h_ > 0 && 2 * h_ - mirror <= forces_.most) {
    for (int k = mirror - h_; k <= mirror + h_ && k < -h_; ++k) {
      kept.k.push_back(k);
    }
  }
  for (int k = -h_; k <= h_; ++k) {
    kept.k.push_back(k);
  }
  for (const int k : kept.k) {
    kept.G.push_back(receptance(point_, omega + step_ * k));
    kept.softest = std::max(kept.softest, largest(kept.G.back()));
  }
  return kept;
}

void RegenerativeLoop::add_column(double omega, const Kept& kept, std::size_t l,
                                  std::vector<Complex>& M) const {
  const std::size_t n = axes_.size() * kept.k.size();
  const Complex slope(0.0, (omega + step_ * kept.k[l]) / Omega_);
  std::vector<Complex> turned;
  for (const double delay : forces_.delays) {
    turned.push_back(std::polar(1.0, -(omega + step_ * kept.k[l]) * delay / Omega_));
  }
  for (std::size_t k = 0; k < kept.k.size(); ++k) {
    const auto wave = static_cast<std::size_t>(forces_.most + kept.k[k] - kept.k[l]);
    ComplexMatrix2 W = forces_.coefficients[0][wave];
    for (std::size_t q = 0; q < W.size() && !forces_.damping.empty(); ++q) {
      W[q] += slope * forces_.damping[wave][q];  // D-33
    }
    for (std::size_t d = 0; d < forces_.delays.size(); ++d) {
      for (std::size_t q = 0; q < W.size(); ++q) {
        W[q] -= turned[d] * forces_.coefficients[d + 1][wave][q];
      }
    }
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      for (std::size_t j = 0; j < axes_.size(); ++j) {
        const std::size_t row = 2 * axes_[i];
        M[(l * axes_.size() + j) * n + k * axes_.size() + i] =
            kept.G[k][row] * W[axes_[j]] +
            kept.G[k][row + 1] * W[2 + axes_[j]];  // D-22
      }
    }
  }
}

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

/// Steps of the scan within a peak of the response.
constexpr double steps_per_peak = 5.0;
/// No step is shorter than this fraction of the distance of two lines.
constexpr double steps_per_line = 3.0;

/// @brief Frequencies from the begin of the band to its end: closer at every peak of the
/// response, and everywhere close for the delay.
/// @param longest  step [rad/s]
std::vector<double> scan_frequencies(const PointResponse& point, double longest) {
  const Band band = band_of(point);
  std::vector<Peak> all;
  for (const MeasuredReceptance& part : point.parts) {
    const std::vector<Peak> of_part = peaks(part);
    all.insert(all.end(), of_part.begin(), of_part.end());
  }
  const double shortest = line_distance(point) / steps_per_line;
  std::vector<double> out;
  for (double omega = band.from; omega < band.to;) {
    out.push_back(omega);
    double step = longest;
    for (const Peak& peak : all) {
      const double away = std::max(peak.width, std::abs(omega - peak.omega));
      step = std::min(step, std::max(shortest, away / steps_per_peak));
    }
    omega += step;
  }
  out.push_back(band.to);
  return out;
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

TriedDepth tried(const OnsetAt& at, double depth, double most) {
  const auto found = at(depth, most);
  return found ? TriedDepth{depth, std::log(found->factor), found->omega}
               : TriedDepth{depth, std::log(most), 0.0};
}

/// Between a stable depth and an unstable one: false position over the logarithm of the
/// depth (Illinois).
FrequencyLimit limit_between(const OnsetAt& at, double Omega, TriedDepth stable,
                             TriedDepth unstable, double tolerance) {
  double weight_stable = stable.g;
  double weight_unstable = unstable.g;
  while (unstable.depth - stable.depth > tolerance * unstable.depth &&
         unstable.g < -0.1 * tolerance) {
    const double t = weight_stable / (weight_stable - weight_unstable);
    const double ratio = unstable.depth / stable.depth;
    const TriedDepth middle = tried(
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
  TriedDepth stable{1e-3 * depth.front(), std::log(1e3)};
  std::size_t k = 0;
  while (k < depth.size()) {
    const TriedDepth here = tried(at, depth[k], far_enough);
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
  const double longest = forces.delays.empty() ? forces.period : forces.delays.back();
  Onset best{.factor = most};
  LoopAt before;
  for (const double omega :
       scan_frequencies(point, unit::turn * Omega / longest / steps_per_wave)) {
    LoopAt now{omega, loop.eigenvalues(omega, kept_beside / best.factor)};
    if (before.omega > 0) {
      follow(loop, before, now, most_bisections, best);
    }
    before = std::move(now);
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
