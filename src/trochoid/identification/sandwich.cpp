#include <trochoid/identification/sandwich.h>

#include <trochoid/base/index.h>
#include <trochoid/identification/spectrum.h>

#include <algorithm>
#include <cmath>

namespace trochoid::identification {

namespace {

using base::index;

/// So many equations to spare make a power: their sum of squares is good to 40 %.
constexpr double enough = 12.0;
/// With fewer of one channel and kind, all rows of the run share one power.
constexpr double too_few_rows = 5.0;

/// What an oscillator that is not quite the dynamometer leaves has the shape of a response:
/// lines agree with their neighbours, and two say no more than one.
constexpr double lines_alike = 2.0;

/// A run by harmonics.
struct Harmonics {
  Spectrum spectrum;
  std::vector<double> x;    ///< shape (rows, unknowns)
  std::vector<double> h;    ///< leverage of each row
  std::vector<bool> tooth;  ///< of each line: a harmonic of the teeth
  double alike = 1.0;       ///< lines that repeat and speak as one
};

/// Power of a row, and the degrees of freedom of its estimate.
struct Power {
  double value = 0.0;  ///< [N^2]
  double freedom = 0.0;
};

/// Sums over rows for what repeats.
struct Excess {
  double squares = 0.0;  ///< beyond what scatter explains
  double freedom = 0.0;  ///< 1 - h of each

  void add(const Harmonics& run, std::size_t row) {
    const double free = 1.0 - std::min(run.h[row], 1.0);
    const double r = run.spectrum.left[row];
    if (r == 0.0 && run.h[row] == 0.0) return;  // a channel that is not there
    squares += r * r - free * run.spectrum.scatter[row];
    freedom += free;
  }
  void add(const Excess& other) {
    squares += other.squares;
    freedom += other.freedom;
  }
};

std::vector<double> leverages(std::span<const double> x, std::span<const double> G) {
  std::vector<double> out;
  const auto p = static_cast<std::size_t>(std::lround(std::sqrt(G.size())));
  for (std::size_t row = 0; row * p < x.size(); ++row) {
    double h = 0.0;
    for (std::size_t i = 0; i < p; ++i) {
      for (std::size_t j = 0; j < p; ++j) {
        h += x[row * p + i] * G[i * p + j] * x[row * p + j];
      }
    }
    out.push_back(h);
  }
  return out;
}

/// The rows of one channel and kind nearest to a harmonic, until they are enough.
Excess near(const Harmonics& run, std::size_t q, std::size_t line) {
  const std::size_t lines = run.spectrum.lines();
  const int k = harmonic_of(line);
  Excess out;
  for (int away = 0; away <= run.spectrum.highest && out.freedom < enough; ++away) {
    for (const int side : {k - away, k + away}) {
      if (side < 0 || side > run.spectrum.highest || (away == 0 && side != k)) continue;
      const std::size_t first = side == 0 ? 0 : index(2 * side - 1);
      if (run.tooth[first] != run.tooth[line]) continue;
      for (std::size_t l = first; l <= index(2 * side); ++l) {
        out.add(run, q * lines + l);
      }
      if (away == 0) break;
    }
  }
  return out;
}

std::vector<Power> powers(const Harmonics& run) {
  const std::size_t lines = run.spectrum.lines();
  Excess all;
  for (std::size_t row = 0; row < run.spectrum.rows(); ++row) all.add(run, row);
  std::vector<Power> out;
  for (std::size_t row = 0; row < run.spectrum.rows(); ++row) {
    Excess own = near(run, row / lines, row % lines);
    if (own.freedom < too_few_rows) own = all;
    const double scatter = run.spectrum.scatter[row];
    const double repeats =
        run.alike * std::max(0.0, own.squares / std::max(own.freedom, 1e-9));
    const double value = scatter + repeats;
    const double s = value > 0 ? scatter / value : 1.0;
    const double spread = s * s / (2.0 * (run.spectrum.turns - 1.0)) +
                          (repeats > 0 ? 1.0 / std::max(own.freedom, 1.0) : 0.0);
    out.push_back({value, 1.0 / spread});
  }
  return out;
}

Harmonics harmonics_of(const Problem& problem, const Spectrum& spectrum,
                       const FoldedRun& folded, const numerics::Columns& J,
                       std::span<const double> G) {
  Harmonics out{spectrum, harmonic_rows(folded, spectrum, J), {}, {}};
  out.h = leverages(out.x, G);
  if (problem.unknowns.resonance_count() > 0) out.alike = lines_alike;
  const int teeth = geometry::equally_pitched(problem.setup.cutter.pitch)
                        ? problem.setup.cutter.teeth()
                        : 1;
  for (std::size_t l = 0; l < spectrum.lines(); ++l) {
    out.tooth.push_back(harmonic_of(l) % teeth == 0);
  }
  return out;
}

/// Sums over the rows of all runs.
struct Scores {
  std::vector<double> covariance;  ///< of the unknowns, shape (p, p)
  std::vector<double> by_root;     ///< of each unknown: variance over root of freedom
  double explained = 0.0;          ///< by chance, by all unknowns [N^2]
};

/// G^-1 x, the part of a row in each unknown.
std::vector<double> influence(std::span<const double> x, std::span<const double> G) {
  const std::size_t p = x.size();
  std::vector<double> out(p, 0.0);
  for (std::size_t i = 0; i < p; ++i) {
    for (std::size_t j = 0; j < p; ++j) out[i] += G[i * p + j] * x[j];
  }
  return out;
}

void add_rows(const Harmonics& run, std::span<const double> G, Scores& sums) {
  const std::size_t p = sums.by_root.size();
  const std::vector<Power> P = powers(run);
  for (std::size_t row = 0; row < P.size(); ++row) {
    sums.explained += P[row].value * run.h[row];
    const std::vector<double> u = influence(std::span(run.x).subspan(row * p, p), G);
    for (std::size_t i = 0; i < p; ++i) {
      for (std::size_t j = 0; j < p; ++j) {
        sums.covariance[i * p + j] += P[row].value * u[i] * u[j];
      }
      sums.by_root[i] += P[row].value * u[i] * u[i] / std::sqrt(P[row].freedom);
    }
  }
}

/// Unknowns that all runs have in common, and the variance of every unknown.
struct Shared {
  std::span<const std::size_t> unknowns;
  std::vector<double> variance;
};

/// I-15, at least 1.
double disagreement(const Problem& problem, const numerics::Columns& J,
                    std::span<const double> left, const Shared& shared,
                    std::span<const double> G) {
  const std::size_t p = J.count();
  const std::size_t R = problem.runs.size();
  if (R < 2 || shared.unknowns.empty()) return 1.0;
  std::vector<double> squares(p, 0.0);
  for (std::size_t r = 0; r < R; ++r) {
    const std::size_t first = first_row(problem, r);
    const std::size_t rows = index(problem.runs[r].rows);
    std::vector<double> g(p, 0.0);
    for (std::size_t c = 0; c < p; ++c) {
      const std::span<const double> column = J[c].subspan(first, rows);
      for (std::size_t i = 0; i < rows; ++i) g[c] += column[i] * left[first + i];
    }
    const std::vector<double> d = influence(g, G);
    for (std::size_t c = 0; c < p; ++c) squares[c] += d[c] * d[c];
  }
  double sum = 0.0;
  for (const std::size_t c : shared.unknowns) sum += squares[c] / shared.variance[c];
  const auto count = static_cast<double>(R);
  return std::max(
      1.0, count / (count - 1.0) * sum / static_cast<double>(shared.unknowns.size()));
}

}  // namespace

std::optional<Sandwich> sandwich(const Problem& problem, const numerics::Columns& J,
                                 std::span<const double> inverse_gram,
                                 std::span<const std::size_t> shared,
                                 const Leftover& left) {
  const std::size_t p = J.count();
  Scores sums{std::vector<double>(p * p, 0.0), std::vector<double>(p, 0.0), 0.0};
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    const FoldedRun& folded = problem.runs[r];
    const Spectrum spectrum = spectrum_of(left.runs[r], left.fitted[r], folded.band);
    if (spectrum.highest < 0) return std::nullopt;
    const numerics::Columns own(J.values.subspan(first_row(problem, r)),
                                index(folded.rows), J.stride);
    add_rows(harmonics_of(problem, spectrum, folded, own, inverse_gram), inverse_gram,
             sums);
  }
  Sandwich out{std::move(sums.covariance), 1e9,
               sums.explained / static_cast<double>(p)};
  Shared common{shared, {}};
  for (std::size_t i = 0; i < p; ++i) {
    const double variance = common.variance.emplace_back(out.covariance[i * p + i]);
    if (!(variance > 0)) continue;  // a slope in time, which is in no harmonic
    const double root = variance / sums.by_root[i];
    out.freedom = std::min(out.freedom, root * root);
  }
  const double B2 = disagreement(problem, J, left.rows, common, inverse_gram);
  out.chance *= B2;
  for (double& v : out.covariance) v *= B2;
  return out;
}

}  // namespace trochoid::identification
