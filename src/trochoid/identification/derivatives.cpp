#include <trochoid/base/index.h>
#include <trochoid/identification/derivatives.h>
#include <trochoid/identification/problem.h>

#include <algorithm>

namespace trochoid::identification {

using base::index;

Derivatives::Derivatives(const Problem& problem, const Evaluation& at,
                         std::span<const double> K)
    : problem_(problem),
      at_(at),
      K_(K.begin(), K.begin() + problem.force_columns()),
      force_(index(problem.rows()), 0.0) {
  numerics::add_combination(design(problem, at).first(K_.size()), K_, 1.0, force_);
}

void Derivatives::find(int i, const Step& step, std::span<double> out) const {
  const Unknowns& u = problem_.unknowns;
  std::ranges::fill(out, 0.0);
  if (i >= u.first_phase()) {
    find_by_phase(index(i - u.first_phase()), step.phase, out);
    return;
  }
  if (i >= u.first_resonance()) {  // all rows are from the turn
    for (std::size_t r = 0; r < problem_.runs.size(); ++r) {
      add_resonance_slope(problem_, at_, i - u.first_resonance(),
                          {r, coefficients(r), 1.0, rows_of_run(r, out)});
    }
    return;
  }
  std::vector<double> p = at_.p;
  p[index(i)] += step.parameter;
  const Point point = point_of(problem_, p);
  for (std::size_t r = 0; r < problem_.runs.size(); ++r) {
    add_force(point, r, 1.0 / step.parameter, out);
  }
  numerics::add_combination({force_, force_.size()}, {{1.0}}, -1.0 / step.parameter,
                            out);
}

/// Those of a run among all rows.
std::span<double> Derivatives::rows_of_run(std::size_t r, std::span<double> all) const {
  return all.subspan(first_row(problem_, r), index(problem_.runs[r].rows));
}

/// The coefficients of a run.
std::span<const double> Derivatives::coefficients(std::size_t r) const {
  return std::span(K_).subspan(first_column(problem_, r), index(problem_.columns));
}

/// Add what the coefficients make of a run at a point.
void Derivatives::add_force(const Point& point, std::size_t r, double factor,
                            std::span<double> out) const {
  const FoldedRun& run = problem_.runs[r];
  if (!run.turn_map.empty()) {
    add_turn_force(problem_, at_, point,
                   {r, coefficients(r), factor, rows_of_run(r, out)});
    return;
  }
  std::vector<double> phi(run.angle);
  for (double& a : phi) a += point.phase[r];
  std::vector<force::Vector3> F = force::forces(
      setup_of(problem_, point, run),
      force::with_coefficients(point.law, coefficients(r)), phi, problem_.tolerance);
  problem_.stop.count(at_.matrix[r].work(phi.size()));
  leave_out_unmeasured(run, {F.front().data(), 3 * F.size()});
  double* const to = &out[first_row(problem_, r)];
  if (run.band == 0) {
    for (std::size_t g = 0; g < F.size(); ++g) {
      const double w = factor * run.weight[g];
      for (std::size_t q = 0; q < 3; ++q) to[3 * g + q] += w * F[g][q];
    }
    return;
  }
  const std::vector<double> rows = rows_of(run, {F.front().data(), 3 * F.size()}, 1);
  for (std::size_t i = 0; i < rows.size(); ++i) to[i] += factor * rows[i];
}

void Derivatives::find_by_phase(std::size_t r, double step,
                                std::span<double> out) const {
  const std::size_t first = first_row(problem_, r);
  const std::size_t own = index(problem_.runs[r].rows);
  if (!problem_.runs[r].turn_map.empty()) {
    add_phase_slope(problem_, at_, {r, coefficients(r), 1.0, rows_of_run(r, out)});
    return;
  }
  Point point = at_.point;
  point.phase[r] += step;
  add_force(point, r, 1.0 / step, out);
  numerics::add_combination({std::span(force_).subspan(first, own), own}, {{1.0}},
                            -1.0 / step, out.subspan(first, own));
}

}  // namespace trochoid::identification
