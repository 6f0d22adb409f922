#include <trochoid/identification/scan.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/local_minimum.h>
#include <trochoid/identification/phase_grid.h>
#include <trochoid/numerics/least_squares.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace trochoid::identification {
namespace {

using base::index;

constexpr signal::Matrix3 as_it_is = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr double scan_tolerance = 1e-4;
/// Of the phases at which one run alone fits best, so many are looked at; at least one
/// for each tooth that may be tooth 1.
constexpr std::size_t most_minima = 4;
constexpr int rounds_of_descent = 3;

/// G^-1 of a small positive semidefinite matrix, as solve_normal has it.
std::vector<double> inverse(std::span<const double> G, std::size_t n) {
  std::vector<double> out(n * n);
  std::vector<double> unit(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    unit[i] = 1.0;
    numerics::solve_normal(G, unit, std::span(out).subspan(i * n, n));
    unit[i] = 0.0;
  }
  return out;
}

/// g^T A g.
double quadratic(std::span<const double> A, std::span<const double> g) {
  const std::size_t n = g.size();
  double out = 0.0;
  for (std::size_t a = 0; a < n; ++a) {
    double row = 0.0;
    for (std::size_t b = 0; b < n; ++b) row += A[a * n + b] * g[b];
    out += g[a] * row;
  }
  return out;
}

/// C^T W F at all shifts when the channels read Q F, shape (shifts, columns).
std::vector<double> right_sides(const Products& at, const signal::Matrix3& Q) {
  if (!at.mixed) return at.X;
  const std::size_t n = at.columns;
  std::vector<double> out(at.shifts * n, 0.0);
  for (std::size_t s = 0; s < at.shifts; ++s) {
    const std::span<const double> X = at.right_at(s);
    for (std::size_t q = 0; q < 3; ++q) {
      for (std::size_t c = 0; c < 3; ++c) {
        if (Q[c][q] == 0.0) continue;
        for (std::size_t a = 0; a < n; ++a) {
          out[s * n + a] += Q[c][q] * X[(3 * q + c) * n + a];
        }
      }
    }
  }
  return out;
}

/// A run against one runout: products at every shift.
struct RunScan {
  Products at;
  std::vector<double> inverse_G;  ///< where it is the same at every shift; else empty
  double squares = 0.0;

  /// What the best coefficients leave at every shift [N^2].
  [[nodiscard]] std::vector<double> left(std::span<const double> g) const {
    const std::size_t n = at.columns;
    std::vector<double> out(at.shifts);
    std::vector<double> K(n);
    for (std::size_t s = 0; s < out.size(); ++s) {
      const std::span<const double> own = g.subspan(s * n, n);
      out[s] = squares - (inverse_G.empty()  // I-12
                              ? numerics::solve_normal(at.gram_at(s), own, K)
                              : quadratic(inverse_G, own));
    }
    return out;
  }
};

/// A phase of one run at which its own best fit is a local minimum.
struct PhaseMinimum {
  double phase = 0.0;
  double rss = 0.0;
  std::size_t shift = 0;
  std::vector<double> g;
};

/// Minimum of a parabola through three equally spaced values, in steps from the middle.
double vertex(double left, double middle, double right) {
  const double curvature = left - 2.0 * middle + right;
  return curvature > 0.0 ? std::clamp(0.5 * (left - right) / curvature, -0.5, 0.5)
                         : 0.0;
}

/// Values between three equally spaced ones, x in steps from the middle.
std::vector<double> on_parabola(const std::array<std::span<const double>, 3>& g,
                                double x) {
  std::vector<double> out(g[1].begin(), g[1].end());
  for (std::size_t a = 0; a < out.size(); ++a) {
    out[a] += 0.5 * x * (g[2][a] - g[0][a] + x * (g[2][a] - 2.0 * g[1][a] + g[0][a]));
  }
  return out;
}

/// The phases of a run at which it fits best by itself, the best first.
std::vector<PhaseMinimum> phase_minima(const RunScan& run, const signal::Matrix3& Q,
                                       std::size_t most) {
  const std::size_t count = run.at.shifts;
  const std::size_t n = run.at.columns;
  const double width = unit::turn / static_cast<double>(count);
  const std::vector<double> all = right_sides(run.at, Q);
  const std::vector<double> rss = run.left(all);
  const auto g_at = [&](std::size_t k) { return std::span(all).subspan(k * n, n); };
  std::vector<PhaseMinimum> out;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t before = (k + count - 1) % count;
    const std::size_t after = (k + 1) % count;
    if (rss[k] > rss[before] || rss[k] > rss[after]) continue;
    const double x = vertex(rss[before], rss[k], rss[after]);
    PhaseMinimum& found = out.emplace_back();
    found.phase = (static_cast<double>(k) + x) * width;
    found.rss = rss[k];
    found.shift = k;
    found.g.assign(g_at(k).begin(), g_at(k).end());
    if (run.inverse_G.empty() || count < 3) continue;
    found.g = on_parabola({g_at(before), g_at(k), g_at(after)}, x);
    found.rss = run.squares - quadratic(run.inverse_G, found.g);
  }
  std::ranges::stable_sort(out, {}, &PhaseMinimum::rss);
  if (out.size() > most) out.resize(most);
  return out;
}

/// Runs with one phase chosen for each. All combinations of their phases would be a power of
/// the number of runs; so one run after the other takes the phase that is best with the rest,
/// until none gains. What runs of different groups leave is added: they have nothing but the
/// runout in common.
class Combination {
 public:
  Combination(const Problem& problem, const std::vector<RunScan>& runs,
              const std::vector<std::vector<PhaseMinimum>>& minima)
      : runs_(runs),
        minima_(minima),
        chosen_(runs.size(), 0),
        members_(problem.groups.size()) {
    for (std::size_t r = 0; r < runs.size(); ++r) {
      members_[problem.group_of.empty() ? 0 : problem.group_of[r]].push_back(r);
    }
    if (std::ranges::any_of(runs,
                            [](const RunScan& r) { return r.inverse_G.empty(); })) {
      return;
    }
    for (const auto& members : members_) {
      inverse_.push_back(inverse(total_gram(members), minima[0][0].g.size()));
    }
  }

  /// The first run at one of its phases, each other where it fits best together with
  /// the rest: by the coefficients of the first run of its group, then by those of all.
  double settle(std::size_t first) {
    std::ranges::fill(chosen_, 0);
    chosen_[0] = first;
    for (const auto& members : members_) follow_first(members);
    double least = rss();
    for (int round = 0; round < rounds_of_descent; ++round) {
      bool better = false;
      for (std::size_t r = 1; r < runs_.size(); ++r) {
        better = improve(r, least) || better;
      }
      if (!better) break;
    }
    return least;
  }

  [[nodiscard]] const PhaseMinimum& of(std::size_t r) const {
    return minima_[r][chosen_[r]];
  }

 private:
  [[nodiscard]] std::span<const double> gram_of(std::size_t r,
                                                const PhaseMinimum& m) const {
    return runs_[r].at.gram_at(m.shift);
  }

  [[nodiscard]] std::vector<double> total_gram(
      std::span<const std::size_t> members) const {
    const std::span<const double> first = gram_of(members[0], of(members[0]));
    std::vector<double> sum(first.begin(), first.end());
    for (const std::size_t r : members.subspan(1)) {
      std::ranges::transform(sum, gram_of(r, of(r)), sum.begin(), std::plus());
    }
    return sum;
  }

  void follow_first(std::span<const std::size_t> members) {
    const PhaseMinimum& m = of(members[0]);
    std::vector<double> K(m.g.size());
    numerics::solve_normal(gram_of(members[0], m), m.g, K);
    for (const std::size_t r : members.subspan(1)) {
      const auto misfit = [&](const PhaseMinimum& other) {
        return quadratic(gram_of(r, other), K) -
               2.0 * std::inner_product(K.begin(), K.end(), other.g.begin(), 0.0);
      };
      const auto best = std::ranges::min_element(minima_[r], {}, misfit);
      chosen_[r] = static_cast<std::size_t>(best - minima_[r].begin());
    }
  }

  /// Sum of squares of all runs, those of one group with the same coefficients.
  [[nodiscard]] double rss() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < members_.size(); ++k) sum += rss_of(k);  // I-19
    return sum;
  }

  [[nodiscard]] double rss_of(std::size_t group) const {
    std::vector<double> g(of(0).g.size(), 0.0);
    double squares = 0.0;
    for (const std::size_t r : members_[group]) {
      std::ranges::transform(g, of(r).g, g.begin(), std::plus());
      squares += runs_[r].squares;
    }
    if (!inverse_.empty()) return squares - quadratic(inverse_[group], g);  // I-12
    std::vector<double> K(g.size());
    return squares - numerics::solve_normal(total_gram(members_[group]), g, K);
  }

  bool improve(std::size_t r, double& least) {
    std::size_t best = chosen_[r];
    const double before = least;
    for (std::size_t m = 0; m < minima_[r].size(); ++m) {
      chosen_[r] = m;
      const double here = rss();
      if (here < least) {
        least = here;
        best = m;
      }
    }
    chosen_[r] = best;
    return least < before;
  }

  const std::vector<RunScan>& runs_;
  const std::vector<std::vector<PhaseMinimum>>& minima_;
  std::vector<std::size_t> chosen_;
  std::vector<std::vector<std::size_t>> members_;  ///< runs of each group
  /// Of the sum of all G of a group, where no phase changes it; else empty.
  std::vector<std::vector<double>> inverse_;
};

/// All runs against one runout.
std::vector<RunScan> run_scans(const Problem& problem,
                               const std::vector<PhaseGrid>& grids,
                               std::span<const double> p, bool mixed) {
  const Point point = point_of(problem, p);
  std::vector<RunScan> out;
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    force::Setup setup = problem.setup;
    setup.runout = point.runout;
    setup.cut = problem.runs[r].cut;
    const force::ForceMatrix matrix(setup, point.law, scan_tolerance);
    const bool free = problem.unknowns.phases > 0;
    const double given = free ? 0.0 : problem.fixed_phase;
    RunScan& run = out.emplace_back();
    run.at = products(grids[r], matrix_on_grid(matrix, grids[r], given),
                      free ? grids[r].size() : 1, mixed);
    run.squares = grids[r].squares;
    if (grids[r].even) run.inverse_G = inverse(run.at.gram_at(0), run.at.columns);
  }
  return out;
}

/// Candidates of one runout and reading.
void add_candidates(const Problem& problem, const std::vector<RunScan>& runs,
                    const signal::Matrix3& Q, std::vector<double> p,
                    std::vector<Candidate>& out) {
  const std::size_t most = std::max(
      most_minima, index(problem.unknowns.phases > 0 ? problem.unknowns.teeth : 1));
  std::vector<std::vector<PhaseMinimum>> minima;
  for (const RunScan& run : runs) {
    minima.push_back(phase_minima(run, Q, most));
    if (minima.back().empty()) return;
  }
  Combination combination(problem, runs, minima);
  for (std::size_t first = 0; first < minima[0].size(); ++first) {
    const double rss = combination.settle(first);
    for (std::size_t r = 0; r < index(problem.unknowns.phases); ++r) {
      p[index(problem.unknowns.first_phase()) + r] = combination.of(r).phase;
    }
    out.push_back({p, rss});
  }
}

}  // namespace

std::vector<std::vector<Candidate>> scan(
    const Problem& problem, const std::vector<std::vector<double>>& runouts,
    std::span<const signal::Matrix3> readings) {
  const bool mixed = readings.size() > 1 || readings.front() != as_it_is;
  std::vector<PhaseGrid> grids;
  for (const FoldedRun& run : problem.runs) grids.push_back(phase_grid_of(run));
  std::vector<double> p =
      parameters_of(problem, {problem.setup.runout, problem.law,
                              std::vector<double>(problem.runs.size(), 0.0)});
  std::vector<std::vector<Candidate>> out(readings.size());
  for (const std::vector<double>& runout : runouts) {
    std::ranges::copy(runout, p.begin());
    if (!in_range(problem, p)) continue;
    try {
      const std::vector<RunScan> runs = run_scans(problem, grids, p, mixed);
      for (std::size_t k = 0; k < readings.size(); ++k) {
        add_candidates(problem, runs, readings[k], p, out[k]);
      }
    } catch (const std::invalid_argument&) {
      continue;  // no such cutter
    }
  }
  for (std::vector<Candidate>& one : out) {
    std::ranges::stable_sort(one, {}, &Candidate::rss);
  }
  return out;
}

std::vector<Candidate> scan(const Problem& problem,
                            const std::vector<std::vector<double>>& runouts) {
  return scan(problem, runouts, {&as_it_is, 1}).front();
}

}  // namespace trochoid::identification
