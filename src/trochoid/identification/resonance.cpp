#include <trochoid/identification/resonance.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/prepare.h>
#include <trochoid/identification/search.h>
#include <trochoid/identification/spectrum.h>
#include <trochoid/identification/uncertainty.h>
#include <trochoid/numerics/columns.h>
#include <trochoid/numerics/least_squares.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

namespace trochoid::identification {

namespace {

using base::index;
using std::complex;

constexpr int most_resolved = 60;
/// What a rigid fit leaves must repeat turn by turn so much beyond what scatter makes of it.
constexpr double repeating = 1.2;
/// A resonance must explain so many times what an equation does by chance: with all
/// frequencies and dampings tried, noise alone reaches about 10.
constexpr double least_gain = 16.0;

/// Of what repeats turn by turn in the axes that ring, oscillators that leave less describe
/// them; such that leave more describe nothing.
constexpr double well_explained = 0.25;
constexpr double hardly_explained = 0.85;
/// Of the slowest resonance: below, an error of its frequency changes the amplification by
/// little more.
constexpr double bearable = 0.7;

/// Where resonances are looked for, in harmonics of the slowest spindle. Slower ones are those
/// of the machine; an amplifier's low-pass may well be slower than a resonance.
constexpr double first_resonance = 3.0;
constexpr double first_low_pass = 1.5;
/// A damping of this and more is that of a low-pass.
constexpr double low_pass = 0.5;
/// Beyond the last harmonic a resonance still amplifies those below it.
constexpr double beyond_last = 1.25;
constexpr int grid_steps = 100;
constexpr std::array dampings{0.02, 0.03, 0.05, 0.08, 0.12, 0.2, 0.35, 0.7};
constexpr double least_damping = 0.015;
constexpr double most_damping = 1.2;

/// In place of an axis: the same resonance in all.
constexpr std::size_t every_axis = 3;

/// By how much slow forces are read too late [s].
double late_by(const Resonance& resonance) {
  return 2.0 * resonance.zeta / resonance.omega;
}

/// @brief The lines of all runs as a model that is linear near a fit has them: columns of
/// the coefficients, and of what else is searched.
///
/// A resonance multiplies the lines of its axis alone, and so the products of the columns at
/// each harmonic by |H|^2: what it leaves with all unknowns at their best costs one small
/// system of equations.
class LinearLines {
 public:
  LinearLines(const Problem& problem, std::span<const double> p) {
    Evaluation at = evaluate(problem, p);
    const std::vector<double> b = measured(problem);
    const numerics::LeastSquares linear =
        numerics::least_squares(design(problem, at), b, rank_tolerance);
    const std::size_t rows = index(problem.rows());
    const std::vector<double> all = jacobian_of(problem, std::move(at), linear.x);
    const std::vector<double> J = without_drift(problem, all);
    columns_ = J.size() / rows;
    for (std::size_t r = 0; r < problem.runs.size(); ++r) {
      const FoldedRun& run = problem.runs[r];
      const std::size_t first = first_row(problem, r);
      add_run(run, {std::span(J).subspan(first), index(run.rows), rows},
              {std::span(b).subspan(first), index(run.rows), rows});
    }
    for (const Harmonic& line : lines_) {
      total_.add(line, 1.0, 1.0);
      squares_ += std::norm(line.measured);
    }
    for (std::size_t c = 0; c < columns_; ++c) {
      const double norm = std::sqrt(total_.gram[c * (c + 3) / 2]);
      scale_.push_back(norm > 0.0 ? 1.0 / norm : 0.0);
    }
  }

  /// @brief Sum of squares that is left when an axis rings besides [N^2].
  ///
  /// All axes together, as behind one amplifier, are late alike, which a rigid fit takes for
  /// its phase: they are looked at about the phase without that.
  /// @param axis  or every_axis
  [[nodiscard]] double left(std::size_t axis, const Resonance& resonance) const {
    Products sum = total_;
    const double late = axis == every_axis ? late_by(resonance) : 0.0;
    for (const Harmonic& line : lines_) {
      if ((axis != every_axis && line.axis != axis) || line.omega == 0.0) continue;
      const complex<double> H =
          oscillation(line.omega, resonance) * std::polar(1.0, line.omega * late);
      sum.add(line, std::norm(H) - 1.0, std::conj(H) - 1.0);
    }
    return left_of(sum);
  }

  [[nodiscard]] double left() const { return left_of(total_); }

  [[nodiscard]] double equations_to_spare() const {
    return 2.0 * static_cast<double>(lines_.size()) - static_cast<double>(columns_);
  }

 private:
  /// Of one axis of one run.
  struct Harmonic {
    std::size_t axis = 0;
    double omega = 0.0;  ///< [rad/s]
    complex<double> measured;
    std::vector<complex<double>> model;  ///< shape (columns)
    std::vector<double> gram;            ///< Re(conj(x) x^T), its lower triangle
  };

  /// G and g of the normal equations.
  struct Products {
    std::vector<double> gram;
    std::vector<double> right;

    void add(const Harmonic& line, double square, complex<double> factor) {
      const std::size_t n = line.model.size();
      gram.resize(line.gram.size(), 0.0);
      right.resize(n, 0.0);
      for (std::size_t i = 0; i < gram.size(); ++i) gram[i] += square * line.gram[i];
      const complex<double> m = factor * line.measured;
      for (std::size_t c = 0; c < n; ++c) {
        right[c] += (std::conj(line.model[c]) * m).real();
      }
    }
  };

  /// Constants and slopes of the channels are in no harmonic.
  static std::vector<double> without_drift(const Problem& problem,
                                           std::span<const double> J) {
    const std::size_t rows = index(problem.rows());
    const std::size_t force = rows * index(problem.force_columns());
    std::vector<double> out(J.begin(), J.begin() + static_cast<std::ptrdiff_t>(force));
    const std::span<const double> rest = J.subspan(rows * index(problem.linear()));
    out.insert(out.end(), rest.begin(), rest.end());
    return out;
  }

  void add_run(const FoldedRun& run, const numerics::Columns& J,
               const numerics::Columns& b) {
    Spectrum shape;
    shape.highest = (run.band - 1) / 2;
    const std::vector<double> X = harmonic_rows(run, shape, J);
    const std::vector<double> F = harmonic_rows(run, shape, b);
    for (std::size_t q = 0; q < 3; ++q) {
      if (!run.measured[q]) continue;
      const std::size_t none = run.drift.empty() ? 0 : 1;  // of the mean
      for (int k = static_cast<int>(none); k <= shape.highest; ++k) {
        Harmonic& line = lines_.emplace_back();
        line.axis = q;
        line.omega = k * run.cut.Omega;
        const std::size_t c = q * shape.lines() + index(k == 0 ? 0 : 2 * k - 1);
        const auto amplitude = [&](std::span<const double> values, std::size_t width,
                                   std::size_t column) {
          return complex<double>(values[c * width + column],
                                 k == 0 ? 0.0 : -values[(c + 1) * width + column]);
        };
        line.measured = amplitude(F, 1, 0);
        for (std::size_t j = 0; j < columns_; ++j) {
          line.model.push_back(amplitude(X, columns_, j));
        }
        for (std::size_t i = 0; i < columns_; ++i) {
          for (std::size_t j = 0; j <= i; ++j) {
            line.gram.push_back((std::conj(line.model[i]) * line.model[j]).real());
          }
        }
      }
    }
  }

  [[nodiscard]] double left_of(const Products& sum) const {
    const std::size_t n = columns_;
    std::vector<double> G(n * n);
    std::vector<double> g(sum.right);
    for (std::size_t i = 0; i < n; ++i) {
      g[i] *= scale_[i];
      for (std::size_t j = 0; j <= i; ++j) {
        const double v = scale_[i] * scale_[j] * sum.gram[i * (i + 1) / 2 + j];
        G[i * n + j] = G[j * n + i] = v;
      }
    }
    std::vector<double> x(n);
    return squares_ - numerics::solve_normal(G, g, x);
  }

  std::size_t columns_ = 0;
  std::vector<Harmonic> lines_;
  Products total_;
  double squares_ = 0.0;
  std::vector<double> scale_;
};

/// The range in which resonances are looked for.
struct Range {
  double slowest = 0.0;  ///< spindle [rad/s]
  double highest = 0.0;  ///< line of all runs [rad/s]
};

/// A resonance that was tried.
struct Tried {
  std::size_t axis = 0;
  Resonance resonance;
  double left = std::numeric_limits<double>::infinity();  ///< [N^2]
};

/// The best of a grid, then smaller and smaller steps about it.
Tried best_resonance(const LinearLines& lines, std::size_t axis, const Range& range) {
  Tried best{axis, {}};
  const auto try_one = [&](double omega, double zeta) {
    const double lowest =
        range.slowest * (zeta < low_pass ? first_resonance : first_low_pass);
    const double least = axis == every_axis ? low_pass : least_damping;
    if (zeta < least || zeta > 1.0 || omega < lowest) return;
    const double left = lines.left(axis, {omega, zeta});
    if (left < best.left) best = {axis, {omega, zeta}, left};
  };
  const double lowest = first_low_pass * range.slowest;
  const double ratio = beyond_last * range.highest / lowest;
  for (int i = 0; i <= grid_steps; ++i) {
    const double omega = lowest * std::pow(ratio, i / double(grid_steps));
    for (const double zeta : dampings) try_one(omega, zeta);
  }
  for (double step = 0.02; step > 1e-4; step *= 0.6) {
    const Resonance at = best.resonance;
    for (const double f : {1.0 - step, 1.0 + step}) {
      try_one(at.omega * f, at.zeta);
      try_one(at.omega, at.zeta * (1.0 + 10.0 * (f - 1.0)));
    }
  }
  return best;
}

/// Of the axes that do not ring yet, or all, what explains most by ringing.
/// @param filtered  whether all may be behind a low-pass: their phases are free
Tried best_of_axes(const LinearLines& lines, const Resonances& found,
                   const Range& range, bool filtered) {
  Tried best;
  const auto rings = [](const auto& one) { return one.has_value(); };
  if (filtered && std::ranges::none_of(found, rings)) {
    best = best_resonance(lines, every_axis, range);
  }
  for (std::size_t q = 0; q < 3; ++q) {
    if (found[q]) continue;
    Tried one = best_resonance(lines, q, range);
    if (one.left < best.left) best = one;
  }
  return best;
}

Range range_of(std::span<const Run> runs, int harmonics) {
  double slowest = runs.front().cut.Omega;
  for (const Run& run : runs) slowest = std::min(slowest, run.cut.Omega);
  return {slowest, harmonics * slowest};
}

/// A fit and its dynamometer, before the numbers of an answer.
struct Ringing {
  Options options;
  Point point;
  double rss = 0.0;  ///< of the rows of its problem
};

/// Whether no resonance has run away: far beyond the last line, or with much damping, it is
/// but a delay.
bool believable(const Resonances& found, const Range& range) {
  return std::ranges::all_of(found, [&](const auto& one) {
    return !one ||
           (one->zeta < most_damping && one->omega < beyond_last * range.highest);
  });
}

/// One more axis that rings; nothing where none explains more than chance.
std::optional<Ringing> with_one_more(const force::Setup& setup, const force::Law& law,
                                     std::span<const Run> runs, const Ringing& now) {
  const Prepared before = prepare(setup, law, runs, now.options);
  if (!before.refusal.empty()) return std::nullopt;
  const LinearLines lines(*before.problem, parameters_of(*before.problem, now.point));
  const Range range = range_of(runs, now.options.band_harmonics);
  const Tried best = best_of_axes(lines, now.options.resonances, range,
                                  before.problem->unknowns.phases > 0);
  const double by_chance =
      least_gain * best.left / std::max(1.0, lines.equations_to_spare());
  if (!(lines.left() - best.left > by_chance)) return std::nullopt;
  Ringing next = now;
  for (std::size_t q = 0; q < 3; ++q) {
    if (now.point.resonances[q]) next.options.resonances[q] = now.point.resonances[q];
  }
  for (std::size_t q = 0; q < 3; ++q) {
    if (best.axis == q || best.axis == every_axis) {
      next.options.resonances[q] = best.resonance;
    }
  }
  for (std::size_t r = 0; best.axis == every_axis && r < runs.size(); ++r) {
    next.point.phase[r] += runs[r].cut.Omega * late_by(best.resonance);
  }
  const Prepared prepared = prepare(setup, law, runs, next.options);
  const Problem& problem = *prepared.problem;
  const Minimum minimum = settle(problem, parameters_of(problem, next.point));
  if (!minimum.converged || !(now.rss - minimum.rss > by_chance)) return std::nullopt;
  next.point = point_of(problem, minimum.p);
  next.rss = minimum.rss;
  return believable(next.point.resonances, range) ? std::optional(next) : std::nullopt;
}

/// Sum of squares of each axis that repeats turn by turn, by the same harmonics [N^2].
std::array<double, 3> repeating_squares(std::span<const Run> runs, const Fit& fit,
                                        int harmonics) {
  std::array<double, 3> out{};
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Spectrum one = spectrum_of(runs[r], fit.fitted[r], 2 * harmonics + 1);
    for (std::size_t i = 0; i < one.rows(); ++i) {
      out[i / one.lines()] += one.left[i] * one.left[i] - one.scatter[i];
    }
  }
  return out;
}

/// What the resonances leave of what repeats in their axes, from 0 to 1.
double part_left(std::span<const Run> runs, const Fit& rigid, const Fit& fit) {
  const int harmonics = fit.options.band_harmonics;
  const auto before = repeating_squares(runs, rigid, harmonics);
  const auto after = repeating_squares(runs, fit, harmonics);
  double all_before = 0.0;
  double all_after = 0.0;
  for (std::size_t q = 0; q < 3; ++q) {
    if (!fit.resonances[q]) continue;
    all_before += std::max(before[q], 0.0);
    all_after += std::max(after[q], 0.0);
  }
  return all_before > 0.0 ? all_after / all_before : 1.0;
}

/// @brief Where the dynamometer is more than one oscillator in an axis, no more is believed
/// than what lies below the slowest, which it amplifies in any case.
std::optional<Fit> below_resonances(const force::Setup& setup, const force::Law& law,
                                    std::span<const Run> runs, const Fit& all) {
  Options options = all.options;
  options.resonances = {};
  options.start = Start{all.runout, all.phase, true};
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const double Omega = runs[r].cut.Omega;
    options.response[r] =
        response_of(all.resonances, Omega, all.options.response[r].highest());
    for (const auto& one : all.resonances) {
      if (!one) continue;
      const double band = bearable * one->omega / Omega;
      options.band_harmonics =
          static_cast<int>(std::min<double>(options.band_harmonics, band));
    }
  }
  if (options.band_harmonics < setup.cutter.teeth()) return std::nullopt;
  Fit fit = identify(setup, law, runs, options);
  if (!fit.ok) return std::nullopt;
  fit.resonances = all.resonances;
  for (auto& one : fit.resonances) {
    if (one) one = Resonance{one->omega, one->zeta};  // errors of another model
  }
  return fit;
}

/// The rigid fit, with rows that a resonance can be put into.
std::optional<Ringing> rigid_by_harmonics(const force::Setup& setup,
                                          const force::Law& law,
                                          std::span<const Run> runs, const Fit& rigid) {
  Ringing out{rigid.options, {rigid.runout, rigid.law, rigid.phase}};
  Options& options = out.options;
  options.band_harmonics = most_resolved;
  for (const Run& run : runs) {
    options.band_harmonics = std::min(options.band_harmonics, resolved_harmonics(run));
  }
  if (options.band_harmonics < std::max(setup.cutter.teeth(), 6)) return std::nullopt;
  for (const Run& run : runs) {
    options.response.push_back(response_of({}, run.cut.Omega, options.band_harmonics));
  }
  const Prepared prepared = prepare(setup, law, runs, options);
  if (!prepared.refusal.empty()) return std::nullopt;
  const Minimum minimum =
      settle(*prepared.problem, parameters_of(*prepared.problem, out.point));
  out.point = point_of(*prepared.problem, minimum.p);
  out.rss = minimum.rss;
  return out;
}

}  // namespace

namespace {

/// What a fit leaves of the mean turn over what scatter makes of it, in squares; nothing
/// where the runs are too short to tell.
std::optional<double> left_over_scatter(std::span<const Run> runs, const Fit& fit) {
  double left = 0.0;
  double scatter = 0.0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Spectrum one = spectrum_of(runs[r], fit.fitted[r], 0);
    if (one.highest < 0) return std::nullopt;
    for (std::size_t i = 0; i < one.rows(); ++i) {
      left += one.left[i] * one.left[i];
      scatter += one.scatter[i];
    }
  }
  return left / scatter;
}

}  // namespace

bool repeats(std::span<const Run> runs, const Fit& fit) {
  const auto ratio = left_over_scatter(runs, fit);
  return ratio && *ratio > repeating;
}

bool leaves_noise_alone(std::span<const Run> runs, const Fit& fit) {
  const auto ratio = left_over_scatter(runs, fit);
  return ratio && *ratio <= repeating;
}

int resolved_harmonics(const Run& run) {
  const double span = std::abs(run.angle.back() - run.angle.front());
  const double per_turn =
      span > 0 ? static_cast<double>(run.angle.size() - 1) * unit::turn / span : 1.0;
  return static_cast<int>(std::clamp(0.4 * per_turn, 1.0, double(most_resolved)));
}

std::optional<Fit> fit_through_resonance(const force::Setup& setup,
                                         const force::Law& law,
                                         std::span<const Run> runs, const Fit& rigid) {
  std::optional<Ringing> now = rigid_by_harmonics(setup, law, runs, rigid);
  bool found = false;
  for (int axis = 0; now && axis < 3 && !rigid.options.stop.wanted(); ++axis) {
    std::optional<Ringing> next = with_one_more(setup, law, runs, *now);
    if (!next) break;
    found = true;
    now = std::move(next);
  }
  if (!found) return std::nullopt;
  Options options = now->options;
  options.resonances = now->point.resonances;
  options.start = Start{now->point.runout, now->point.phase, true};
  Fit fit = identify(setup, law, runs, options);
  if (!fit.ok) return std::nullopt;
  const double left = part_left(runs, rigid, fit);
  if (left < well_explained) return fit;
  if (left > hardly_explained) return std::nullopt;
  return below_resonances(setup, law, runs, fit);
}

namespace {

/// A response that amplifies no more than this has no resonance within its lines.
constexpr double amplified = 1.2;

/// @brief The oscillator that a diagonal of the response is most like: 1/H is linear in
/// 1/omega_n^2 and zeta/omega_n.
std::optional<Resonance> main_resonance(const Response& response, double Omega,
                                        std::size_t axis) {
  double highest = 0.0;
  std::array<double, 4> sums{};
  for (std::size_t k = 1; k < response.harmonic.size(); ++k) {
    const complex<double> H = response.harmonic[k][4 * axis];
    if (!(std::abs(H) > 0.0)) continue;
    highest = std::max(highest, std::abs(H));
    const double w = std::norm(H) * std::norm(H);  // as errors of H count
    const double omega = static_cast<double>(k) * Omega;
    const complex<double> inverse = 1.0 / H;
    sums[0] += w * omega * omega * (1.0 - inverse.real());
    sums[1] += w * std::pow(omega, 4);
    sums[2] += w * omega * inverse.imag();
    sums[3] += w * omega * omega;
  }
  if (!(highest > amplified) || !(sums[0] > 0.0) || !(sums[2] > 0.0)) return {};
  const double omega_n = std::sqrt(sums[1] / sums[0]);
  const double zeta = 0.5 * omega_n * sums[2] / sums[3];
  const double last = static_cast<double>(response.highest()) * Omega;
  const bool there = omega_n < last && zeta > least_damping && zeta < low_pass;
  return there ? std::optional(Resonance{omega_n, zeta}) : std::nullopt;
}

}  // namespace

std::optional<Options> with_scaled_response(std::span<const Run> runs,
                                            Options options) {
  bool any = false;
  for (std::size_t q = 0; q < 3; ++q) {
    options.resonances[q] =
        main_resonance(options.response.front(), runs.front().cut.Omega, q);
    any = any || options.resonances[q];
  }
  if (!any) return std::nullopt;
  for (std::size_t r = 0; r < runs.size(); ++r) {  // I-25
    Response& response = options.response[r];
    const Response held =
        response_of(options.resonances, runs[r].cut.Omega, response.highest());
    for (std::size_t k = 0; k < response.harmonic.size(); ++k) {
      for (std::size_t i = 0; i < 9; ++i) {
        response.harmonic[k][i] /= held.harmonic[k][4 * (i / 3)];
      }
    }
  }
  return options;
}

}  // namespace trochoid::identification
