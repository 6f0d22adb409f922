#include <trochoid/identification/problem.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/turn_rows.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace trochoid::identification {
namespace {

using base::index;

force::Setup setup_of(const Problem& problem, const Point& point,
                      const FoldedRun& run) {
  force::Setup setup = problem.setup;
  setup.runout = point.runout;
  setup.cut = run.cut;
  return setup;
}

/// The matrix at the angles of a run, in its rows.
std::vector<double> rows_at(const force::ForceMatrix& matrix, const FoldedRun& run,
                            double phase) {
  std::vector<double> phi(run.angle);
  for (double& a : phi) a += phase;
  std::vector<double> C(phi.size() * 3 * index(matrix.columns()));
  matrix.evaluate(phi, C);
  return rows_of(run, C, matrix.columns());
}

/// The grid of a turn that serves a band: fine where angles cost little.
TurnGrid grid_of(const Problem& problem, const FoldedRun& run) {
  const int least = std::max(problem.angles, 8 * run.harmonics);
  const auto angles = static_cast<int>(std::bit_ceil(static_cast<unsigned>(least)));
  const bool sudden = enters_suddenly(problem, run, unit::turn / angles);
  const int fine = force::keeps_radius(problem.setup) && !sudden ? 4 * angles : angles;
  return {fine, std::min(run.highest, fine / 2 - 1), sudden};
}

std::vector<double> rows_at(const Problem& problem, const Evaluation& at,
                            std::size_t r) {
  const FoldedRun& run = problem.runs[r];
  const double phase = at.point.phase[r];
  return run.turn_map.empty()
             ? rows_at(at.matrix[r], run, phase)
             : rows_of_turn(run, at_phase(at.turn[r], phase), problem.columns);
}

/// out += factor D K, D of shape (out, columns).
void add_force(std::span<const double> D, std::span<const double> K, double factor,
               std::span<double> out) {
  const std::size_t columns = K.size();
  for (std::size_t i = 0; i < out.size(); ++i) {
    double sum = 0.0;
    for (std::size_t c = 0; c < columns; ++c) sum += D[i * columns + c] * K[c];
    out[i] += factor * sum;
  }
}

/// Difference of [D] K between two evaluations over their distance, all runs.
std::vector<double> quotient(const Problem& problem, const Evaluation& a,
                             const Evaluation& b, double distance,
                             std::span<const double> K) {
  std::vector<double> out;
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    std::vector<double> dF(index(problem.runs[r].rows), 0.0);
    add_force(b.rows[r], K, 1.0 / distance, dF);
    add_force(a.rows[r], K, -1.0 / distance, dF);
    out.insert(out.end(), dF.begin(), dF.end());
  }
  return out;
}

/// The same for a phase, which concerns one run and needs no new matrix; and no
/// difference where the rows are from the turn.
std::vector<double> phase_slope(const Problem& problem, const Evaluation& at,
                                std::size_t r, std::span<const double> K,
                                const Step& step) {
  const FoldedRun& run = problem.runs[r];
  const double phase = at.point.phase[r];
  std::vector<double> dF(index(run.rows), 0.0);
  if (!run.turn_map.empty()) {
    add_force(rows_of_turn(run, slope_at_phase(at.turn[r], phase), problem.columns), K,
              1.0, dF);
    return dF;
  }
  const double d = step.central ? 2.0 * step.phase : step.phase;
  add_force(rows_at(at.matrix[r], run, phase + step.phase), K, 1.0 / d, dF);
  add_force(step.central ? rows_at(at.matrix[r], run, phase - step.phase) : at.rows[r],
            K, -1.0 / d, dF);
  return dF;
}

/// Whether two points have the same matrices, before the phases.
bool same_matrices(const Problem& problem, std::span<const double> a,
                   std::span<const double> b) {
  const std::size_t n = index(problem.unknowns.first_phase());
  return a.size() == b.size() && std::ranges::equal(a.first(n), b.first(n));
}

}  // namespace

int Unknowns::runout_count() const noexcept {
  if (runout == RunoutUnknowns::offsets) return teeth - 1;
  if (runout == RunoutUnknowns::eccentricity) return direction ? 1 : 2;
  return 0;
}

int Problem::drift_columns() const noexcept {
  return runs.front().drift.empty() ? 0 : 6 * static_cast<int>(runs.size());
}

int Problem::rows() const noexcept {
  int sum = 0;
  for (const FoldedRun& run : runs) sum += run.rows;
  return sum;
}

Point point_of(const Problem& problem, std::span<const double> p) {
  const Unknowns& u = problem.unknowns;
  Point out{problem.setup.runout, problem.law, {}};
  if (u.runout == RunoutUnknowns::offsets) {
    out.runout.radial_offsets.assign(index(u.teeth), 0.0);
    for (int k = 1; k < u.teeth; ++k) {
      out.runout.radial_offsets[index(k)] = u.length * p[index(k - 1)];
    }
  } else if (u.runout == RunoutUnknowns::eccentricity) {
    const double c = u.direction ? p[0] * std::cos(*u.direction) : p[0];
    const double s = u.direction ? p[0] * std::sin(*u.direction) : p[1];
    out.runout.eccentricity = u.length * std::hypot(c, s);
    out.runout.angle = c == 0.0 && s == 0.0 ? 0.0 : std::atan2(s, c);
  }
  if (u.exponents) {
    const std::size_t at = index(u.runout_count());
    out.law = force::with_exponents(out.law, p.subspan(at).first<3>());
  }
  out.phase.assign(problem.runs.size(), problem.fixed_phase);
  for (int r = 0; r < u.phases; ++r)
    out.phase[index(r)] = p[index(u.first_phase() + r)];
  return out;
}

std::vector<double> parameters_of(const Problem& problem, const Point& point) {
  const Unknowns& u = problem.unknowns;
  std::vector<double> p;
  p.reserve(index(u.count()));
  if (u.runout == RunoutUnknowns::offsets) {
    const auto& s = point.runout.radial_offsets;
    for (std::size_t k = 1; k < index(u.teeth); ++k) {
      p.push_back(s.empty() ? 0.0 : (s[k] - s[0]) / u.length);
    }
  } else if (u.runout == RunoutUnknowns::eccentricity) {
    const double rho = point.runout.eccentricity / u.length;
    if (u.direction) {
      p.push_back(rho * std::cos(point.runout.angle - *u.direction));
    } else {
      p.push_back(rho * std::cos(point.runout.angle));
      p.push_back(rho * std::sin(point.runout.angle));
    }
  }
  if (u.exponents) {
    const auto m = force::form(point.law).m;
    p.insert(p.end(), m.begin(), m.end());
  }
  p.insert(p.end(), point.phase.begin(), point.phase.begin() + u.phases);
  return p;
}

bool in_range(const Problem& problem, std::span<const double> p) {
  const Unknowns& u = problem.unknowns;
  const double limit = 0.2 * problem.setup.cutter.profile.D / u.length;
  const int runout = u.runout_count();
  for (int i = 0; i < u.count(); ++i) {
    const double v = p[index(i)];
    if (!std::isfinite(v)) return false;
    if (i < runout && std::abs(v) > limit) return false;
    if (i >= runout && i < u.first_phase() && (v >= 0.98 || v < -0.5)) return false;
  }
  return true;
}

bool enters_suddenly(const Problem& problem, const FoldedRun& run, double step) {
  if (!force::form(problem.law).edge) return false;
  const geometry::Cutter& cutter = problem.setup.cutter;
  const double lag = 2.0 * run.cut.a_p * std::tan(cutter.helix) / cutter.lag_diameter;
  return lag < 2.0 * step;
}

Evaluation evaluate(const Problem& problem, std::span<const double> p,
                    const Evaluation* known) {
  Evaluation out;
  out.p.assign(p.begin(), p.end());
  out.point = point_of(problem, p);
  const bool again =
      known != nullptr && !known->matrix.empty() && same_matrices(problem, p, known->p);
  if (again) {
    out.matrix = known->matrix;
    out.turn = known->turn;
  }
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    const FoldedRun& run = problem.runs[r];
    if (out.matrix.size() == r) {
      out.matrix.emplace_back(setup_of(problem, out.point, run), out.point.law,
                              problem.tolerance);
      out.turn.push_back(run.turn_map.empty()
                             ? TurnMatrix{}
                             : turn_matrix(out.matrix[r], grid_of(problem, run)));
    }
    const bool same = again && out.point.phase[r] == known->point.phase[r];
    out.rows.push_back(same ? known->rows[r] : rows_at(problem, out, r));
  }
  return out;
}

std::vector<double> design(const Problem& problem, const Evaluation& evaluation) {
  const std::size_t columns = index(problem.columns);
  const std::size_t linear = index(problem.linear());
  std::vector<double> out(index(problem.rows()) * linear, 0.0);
  std::size_t row = 0;
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    const FoldedRun& run = problem.runs[r];
    const std::vector<double>& D = evaluation.rows[r];
    for (std::size_t i = 0; i < index(run.rows); ++i, ++row) {
      double* const to = &out[row * linear];
      std::copy_n(&D[i * columns], columns, to);
      if (!run.drift.empty()) std::copy_n(&run.drift[6 * i], 6, to + columns + 6 * r);
    }
  }
  return out;
}

std::vector<double> measured(const Problem& problem) {
  std::vector<double> out;
  out.reserve(index(problem.rows()));
  for (const FoldedRun& run : problem.runs) {
    out.insert(out.end(), run.b.begin(), run.b.end());
  }
  return out;
}

std::vector<double> derivative(const Problem& problem, const Evaluation& at, int i,
                               std::span<const double> K, const Step& step) {
  const Unknowns& u = problem.unknowns;
  const std::span<const double> force_K = K.first(index(problem.columns));
  if (i >= u.first_phase()) {
    const std::size_t own = index(i - u.first_phase());
    std::vector<double> out(index(problem.rows()), 0.0);
    std::size_t row = 0;
    for (std::size_t r = 0; r < own; ++r) row += index(problem.runs[r].rows);
    std::ranges::copy(phase_slope(problem, at, own, force_K, step),
                      out.begin() + static_cast<std::ptrdiff_t>(row));
    return out;
  }
  std::vector<double> moved = at.p;
  moved[index(i)] += step.parameter;
  const Evaluation plus = evaluate(problem, moved);
  if (!step.central) return quotient(problem, at, plus, step.parameter, force_K);
  moved[index(i)] -= 2.0 * step.parameter;
  const Evaluation minus = evaluate(problem, moved);
  return quotient(problem, minus, plus, 2.0 * step.parameter, force_K);
}

}  // namespace trochoid::identification
