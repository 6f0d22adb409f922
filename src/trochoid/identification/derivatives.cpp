#include <trochoid/base/index.h>
#include <trochoid/identification/derivatives.h>

#include <algorithm>

namespace trochoid::identification {

using base::index;

void Derivatives::find(const Evaluation& at, std::span<const double> K, int i,
                       const Step& step, std::span<double> out) {
  const Unknowns& u = problem_.unknowns;
  const std::span<const double> force_K = K.first(index(problem_.columns));
  std::ranges::fill(out, 0.0);
  if (i >= u.first_phase()) {
    find_by_phase(at, force_K, index(i - u.first_phase()), step.phase, out);
    return;
  }
  std::vector<double> p = at.p;
  p[index(i)] += step.parameter;
  evaluate(problem_, p, nullptr, moved_);
  const auto add = [&](const Evaluation& from, double factor) {
    numerics::add_combination(design(problem_, from).first(force_K.size()), force_K,
                              factor, out);
  };
  add(moved_, 1.0 / step.parameter);
  add(at, -1.0 / step.parameter);
}

void Derivatives::find_by_phase(const Evaluation& at, std::span<const double> K,
                                std::size_t r, double step, std::span<double> out) {
  const std::size_t first = first_row(problem_, r);
  const std::size_t own = index(problem_.runs[r].rows);
  const std::size_t rows = index(problem_.rows());
  const auto add = [&](std::span<const double> C, double factor) {
    numerics::add_combination(numerics::Columns(C, own, rows).first(K.size()), K,
                              factor, out.subspan(first, own));
  };
  C_.resize(rows * K.size());
  if (!problem_.runs[r].turn_map.empty()) {
    fill_phase_slope(problem_, at, r, C_);
    add(C_, 1.0);
    return;
  }
  Evaluation ahead{{}, at.point, at.matrix, {}, {}};
  ahead.point.phase[r] += step;
  fill_run(problem_, ahead, r, C_);
  add(C_, 1.0 / step);
  add(std::span(at.D).subspan(first), -1.0 / step);
}

}  // namespace trochoid::identification
