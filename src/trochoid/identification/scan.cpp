#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/runout_starts.h>
#include <trochoid/identification/scan.h>
#include <trochoid/identification/variable_projection.h>
#include <trochoid/numerics/least_squares.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trochoid::identification {
namespace {

/// Cells of the turn: 3 degrees, a fraction of
/// what a force curve needs to show its shape.
constexpr std::size_t cells = 120;

using base::index;

/// A run averaged over the cells of the turn.
struct Cells {
  std::vector<double> weight;                ///< number of samples
  std::vector<std::array<double, 3>> force;  ///< mean [N]
  bool even = false;                         ///< the weights are equal
  double squares = 0.0;                      ///< weighted sum of F^2 [N^2]
};

Cells cells_of(const FoldedRun& run) {
  Cells out{std::vector<double>(cells, 0.0), std::vector<std::array<double, 3>>(cells),
            false, 0.0};
  for (std::size_t g = 0; g < run.angle.size(); ++g) {
    const double a = run.angle[g] / unit::turn;
    const auto cell =
        std::min(cells - 1, static_cast<std::size_t>((a - std::floor(a)) * cells));
    const double w = run.weight[g] * run.weight[g];
    out.weight[cell] += w;
    for (std::size_t q = 0; q < 3; ++q) out.force[cell][q] += w * run.force[g][q];
  }
  for (std::size_t i = 0; i < cells; ++i) {
    if (out.weight[i] == 0.0) continue;
    for (double& f : out.force[i]) {
      f /= out.weight[i];
      out.squares += out.weight[i] * f * f;
    }
  }
  out.even = std::ranges::all_of(out.weight, [&](double w) {
    return std::abs(w - out.weight[0]) < 1e-9 * out.weight[0];
  });
  return out;
}

std::vector<double> cell_angles() {
  std::vector<double> out(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    out[i] = (static_cast<double>(i) + 0.5) * unit::turn / static_cast<double>(cells);
  }
  return out;
}

/// The force matrix over the cells, and whether the means of the channels are taken out
/// (because the channels have an offset of their own).
struct Grid {
  std::vector<double> C;  ///< shape (cells, 3, columns)
  std::size_t columns = 0;
  bool centered = false;
};

/// Products of the columns, weighted as the data at one shift.
struct Gram {
  std::vector<double> G;
  std::vector<double> sums;  ///< of the columns, shape (3, columns)
  double weight = 0.0;
};

Gram gram_at(const Cells& data, const Grid& grid, std::size_t shift) {
  const std::size_t n = grid.columns;
  Gram out{std::vector<double>(n * n, 0.0), std::vector<double>(3 * n, 0.0), 0.0};
  for (std::size_t i = 0; i < cells; ++i) {
    const double w = data.weight[i];
    if (w == 0.0) continue;
    const double* const rows = &grid.C[((i + shift) % cells) * 3 * n];
    out.weight += w;
    for (std::size_t q = 0; q < 3; ++q) {
      const double* const c = rows + q * n;
      for (std::size_t a = 0; a < n; ++a) {
        out.sums[q * n + a] += w * c[a];
        for (std::size_t b = 0; b <= a; ++b) out.G[a * n + b] += w * c[a] * c[b];
      }
    }
  }
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) out.G[a * n + b] = out.G[b * n + a];
  }
  return out;
}

/// Normal equations of one run at one shift.
struct Normal {
  std::vector<double> G;
  std::vector<double> g;
  double squares = 0.0;

  void add(const Normal& other) {
    for (std::size_t i = 0; i < G.size(); ++i) G[i] += other.G[i];
    for (std::size_t i = 0; i < g.size(); ++i) g[i] += other.g[i];
    squares += other.squares;
  }
};

void center(const Gram& gram, const std::array<double, 3>& sum_F, Normal& normal) {
  const std::size_t n = normal.g.size();
  for (std::size_t q = 0; q < 3; ++q) {
    const double* const sum_C = &gram.sums[q * n];
    for (std::size_t a = 0; a < n; ++a) {
      const double c = sum_C[a] / gram.weight;
      normal.g[a] -= c * sum_F[q];
      for (std::size_t b = 0; b < n; ++b) normal.G[a * n + b] -= c * sum_C[b];
    }
    normal.squares -= sum_F[q] * sum_F[q] / gram.weight;
  }
}

Normal normal_at(const Cells& data, const Grid& grid, std::size_t shift,
                 const Gram& gram) {
  const std::size_t n = grid.columns;
  Normal out{gram.G, std::vector<double>(n, 0.0), data.squares};
  std::array<double, 3> sum_F{};
  for (std::size_t i = 0; i < cells; ++i) {
    const double* const rows = &grid.C[((i + shift) % cells) * 3 * n];
    for (std::size_t q = 0; q < 3; ++q) {
      const double wF = data.weight[i] * data.force[i][q];
      sum_F[q] += wF;
      for (std::size_t a = 0; a < n; ++a) out.g[a] += wF * rows[q * n + a];
    }
  }
  if (grid.centered) center(gram, sum_F, out);
  return out;
}

double rss_of(const Normal& normal) {
  std::vector<double> K(normal.g.size());
  return normal.squares - numerics::solve_normal(normal.G, normal.g, K);
}

/// Minimum of a parabola through three equally spaced values, in steps from the middle.
double vertex(double left, double middle, double right) {
  const double curvature = left - 2.0 * middle + right;
  return curvature > 0.0 ? std::clamp(0.5 * (left - right) / curvature, -0.5, 0.5)
                         : 0.0;
}

/// A phase of one run at which its own best fit is a local minimum.
struct PhaseMinimum {
  double phase = 0.0;
  double rss = 0.0;
  Normal normal;
};

std::vector<PhaseMinimum> phase_minima(const Cells& data, const Grid& grid,
                                       double span) {
  const double width = unit::turn / static_cast<double>(cells);
  const int half = static_cast<int>(std::ceil(0.5 * span / width));
  const bool all = 2 * half >= static_cast<int>(cells);
  const int first = all ? 0 : -half;
  const int last = all ? static_cast<int>(cells) - 1 : half;
  const Gram even = gram_at(data, grid, 0);
  const auto at = [&](int k) {
    const std::size_t shift = index(k + static_cast<int>(cells)) % cells;
    // With equal weights a shift changes the order of the sums only.
    return normal_at(data, grid, shift, data.even ? even : gram_at(data, grid, shift));
  };
  std::vector<double> rss;
  for (int k = first; k <= last; ++k) rss.push_back(rss_of(at(k)));
  std::vector<PhaseMinimum> out;
  const std::size_t count = rss.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double left = i > 0 ? rss[i - 1] : (all ? rss[count - 1] : rss[i + 1]);
    const double right = i + 1 < count ? rss[i + 1] : (all ? rss[0] : rss[i - 1]);
    if (rss[i] > left || rss[i] > right) continue;
    const double k = first + static_cast<double>(i);
    out.push_back({(k + vertex(left, rss[i], right)) * width, rss[i], {}});
  }
  std::ranges::sort(out, {}, &PhaseMinimum::rss);
  if (out.size() > 2) out.resize(2);
  for (PhaseMinimum& m : out) {
    m.normal = at(static_cast<int>(std::lround(m.phase / width)));
  }
  return out;
}

/// Candidates of one runout: the best phases of all
/// runs, and each run at its second best.
void combine(std::vector<double> p,
             const std::vector<std::vector<PhaseMinimum>>& minima, int first_phase,
             std::vector<Candidate>& out) {
  for (std::size_t other = 0; other <= minima.size(); ++other) {
    if (other < minima.size() && minima[other].size() < 2) continue;
    Normal sum;
    for (std::size_t r = 0; r < minima.size(); ++r) {
      const PhaseMinimum& m = minima[r][r == other ? 1 : 0];
      p[index(first_phase) + r] = m.phase;
      if (r == 0) {
        sum = m.normal;
      } else {
        sum.add(m.normal);
      }
    }
    out.push_back({p, rss_of(sum)});
  }
}

void scan_phases(const Problem& problem, const std::vector<Cells>& data, double span,
                 std::vector<double> p, std::vector<Candidate>& out) {
  const Point point = point_of(problem, p);
  const auto n = index(problem.columns);
  const std::vector<double> phi = cell_angles();
  std::vector<std::vector<PhaseMinimum>> minima;
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    force::Setup setup = problem.setup;
    setup.runout = point.runout;
    setup.cut = problem.runs[r].cut;
    Grid grid{std::vector<double>(cells * 3 * n), n, !problem.runs[r].drift.empty()};
    force::ForceMatrix(setup, point.law, 1e-4).evaluate(phi, grid.C);
    minima.push_back(phase_minima(data[r], grid, r == 0 ? span : unit::turn));
    if (minima.back().empty()) return;
  }
  combine(std::move(p), minima, problem.unknowns.first_phase(), out);
}

}  // namespace

std::vector<Candidate> scan(const Problem& problem, double span) {
  const Unknowns& u = problem.unknowns;
  std::vector<Cells> data;
  for (const FoldedRun& run : problem.runs) data.push_back(cells_of(run));
  std::vector<double> p =
      parameters_of(problem, {problem.setup.runout, problem.law,
                              std::vector<double>(problem.runs.size(), 0.0)});
  std::vector<Candidate> out;
  for (const std::vector<double>& runout : runout_starts(problem)) {
    std::ranges::copy(runout, p.begin());
    if (!in_range(problem, p)) continue;
    if (u.phases == 0) {
      out.push_back({p, rss_at(problem, p)});
      continue;
    }
    try {
      scan_phases(problem, data, span, p, out);
    } catch (const std::invalid_argument&) {
      continue;  // no such cutter
    }
  }
  std::ranges::stable_sort(out, {}, &Candidate::rss);
  return out;
}

}  // namespace trochoid::identification
