#include <trochoid/identification/problem.h>

#include <trochoid/base/index.h>

#include <algorithm>
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

std::vector<double> matrix_at(const force::ForceMatrix& matrix, const FoldedRun& run,
                              double phase) {
  std::vector<double> phi(run.angle);
  for (double& a : phi) a += phase;
  std::vector<double> C(phi.size() * 3 * index(matrix.columns()));
  matrix.evaluate(phi, C);
  return C;
}

/// out += factor C K, shape (u, 3).
void add_force(std::span<const double> C, std::span<const double> K, double factor,
               std::span<double> out) {
  const std::size_t columns = K.size();
  for (std::size_t i = 0; i < out.size(); ++i) {
    double sum = 0.0;
    for (std::size_t c = 0; c < columns; ++c) sum += C[i * columns + c] * K[c];
    out[i] += factor * sum;
  }
}

/// Difference of C K between two evaluations over their distance, all runs.
std::vector<double> quotient(const Problem& problem, const Evaluation& a,
                             const Evaluation& b, double distance,
                             std::span<const double> K) {
  std::vector<double> out;
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    std::vector<double> dF(3 * problem.runs[r].angle.size(), 0.0);
    add_force(b.C[r], K, 1.0 / distance, dF);
    add_force(a.C[r], K, -1.0 / distance, dF);
    const std::vector<double> rows = rows_of(problem.runs[r], dF, 1);
    out.insert(out.end(), rows.begin(), rows.end());
  }
  return out;
}

/// The same for a phase, which concerns one run and needs no new matrix.
std::vector<double> phase_quotient(const Problem& problem, const Evaluation& at,
                                   std::size_t run, std::span<const double> K,
                                   const Step& step) {
  std::vector<double> out;
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    std::vector<double> dF(3 * problem.runs[r].angle.size(), 0.0);
    if (r == run) {
      const double phase = at.point.phase[r];
      const double d = step.central ? 2.0 * step.phase : step.phase;
      add_force(matrix_at(at.matrix[r], problem.runs[r], phase + step.phase), K,
                1.0 / d, dF);
      add_force(step.central
                    ? matrix_at(at.matrix[r], problem.runs[r], phase - step.phase)
                    : at.C[r],
                K, -1.0 / d, dF);
    }
    const std::vector<double> rows = rows_of(problem.runs[r], dF, 1);
    out.insert(out.end(), rows.begin(), rows.end());
  }
  return out;
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

Evaluation evaluate(const Problem& problem, std::span<const double> p) {
  Evaluation out;
  out.p.assign(p.begin(), p.end());
  out.point = point_of(problem, p);
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    const FoldedRun& run = problem.runs[r];
    out.matrix.emplace_back(setup_of(problem, out.point, run), out.point.law,
                            problem.tolerance);
    out.C.push_back(matrix_at(out.matrix.back(), run, out.point.phase[r]));
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
    const std::vector<double> D = rows_of(run, evaluation.C[r], problem.columns);
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
    return phase_quotient(problem, at, index(i - u.first_phase()), force_K, step);
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
