#include <trochoid/identification/variable_projection.h>
#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/secant_levenberg_marquardt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

namespace trochoid::identification {
namespace {

double squared(std::span<const double> v) {
  return std::inner_product(v.begin(), v.end(), v.begin(), 0.0);
}

/// Everything known at one p.
struct State {
  std::vector<double> p;
  Evaluation evaluation;
  std::vector<double> D;
  std::vector<double> K;
  std::vector<double> residual;
};

std::optional<State> state_at(const Problem& problem, std::span<const double> p,
                              const Evaluation* known) {
  if (!in_range(problem, p)) return std::nullopt;
  State out;
  out.p.assign(p.begin(), p.end());
  try {
    out.evaluation = evaluate(problem, p, known);
  } catch (const std::invalid_argument&) {
    return std::nullopt;  // a cutter that cannot be, such as a radius below zero
  }
  out.D = design(problem, out.evaluation);
  out.residual = measured(problem);
  out.K = numerics::project_out(out.D, problem.linear(), out.residual, 1);
  return out;
}

/// Derivatives of the residual: column-major, shape (rows, unknowns).
void fill_jacobian(const Problem& problem, const State& state, const Step& step,
                   std::span<double> jacobian) {
  const auto rows = static_cast<std::size_t>(problem.rows());
  const int count = problem.unknowns.count();
  const auto width = static_cast<std::size_t>(count);
  std::vector<double> B(rows * width);
  for (std::size_t i = 0; i < width; ++i) {
    const std::vector<double> column =
        derivative(problem, state.evaluation, static_cast<int>(i), state.K, step);
    for (std::size_t k = 0; k < rows; ++k) B[k * width + i] = -column[k];
  }
  numerics::project_out(state.D, problem.linear(), B, count);
  for (std::size_t k = 0; k < rows; ++k) {
    for (std::size_t i = 0; i < width; ++i) jacobian[i * rows + k] = B[k * width + i];
  }
}

}  // namespace

double rss_at(const Problem& problem, std::span<const double> p) {
  Evaluation last;
  return rss_at(problem, p, last);
}

double rss_at(const Problem& problem, std::span<const double> p, Evaluation& last) {
  std::optional<State> state = state_at(problem, p, &last);
  if (!state) return std::numeric_limits<double>::infinity();
  last = std::move(state->evaluation);
  return squared(state->residual);
}

std::vector<double> residual_at(const Problem& problem, std::span<const double> p) {
  std::optional<State> state = state_at(problem, p, nullptr);
  return state ? std::move(state->residual) : measured(problem);
}

Minimum refine(const Problem& problem, std::vector<double> start, const Step& step,
               const numerics::LevenbergMarquardtOptions& options) {
  Minimum out{std::move(start), 0.0, true, "nothing to search"};
  if (problem.unknowns.count() == 0) {
    out.rss = rss_at(problem, out.p);
    return out;
  }
  const double scale = std::sqrt(squared(measured(problem)));
  if (!(scale > 0.0)) return out;
  // The last place, and the one before it: steps that gain nothing lead back there.
  std::array<std::optional<State>, 2> known;
  const auto state = [&](std::span<const double> p) -> const State* {
    for (std::size_t i = 0; i < 2; ++i) {
      if (!known[i] || !std::ranges::equal(known[i]->p, p)) continue;
      std::swap(known[0], known[i]);
      return &*known[0];
    }
    std::optional<State> next =
        state_at(problem, p, known[0] ? &known[0]->evaluation : nullptr);
    if (!next) return nullptr;
    known[1] = std::exchange(known[0], std::move(next));
    return &*known[0];
  };
  const auto residuals = [&](std::span<const double> p, std::span<double> r,
                             std::span<double> jacobian) {
    const State* const here = state(p);
    if (here == nullptr) return false;
    std::ranges::transform(here->residual, r.begin(),
                           [&](double v) { return v / scale; });
    if (!jacobian.empty()) {
      fill_jacobian(problem, *here, step, jacobian);
      for (double& j : jacobian) j /= scale;
    }
    return true;
  };
  const auto summary =
      numerics::secant_levenberg_marquardt(residuals, problem.rows(), out.p, options);
  out.p = summary.p;
  out.rss = 2.0 * summary.final_cost * scale * scale;
  out.converged = summary.converged;
  out.reason = summary.reason;
  return out;
}

}  // namespace trochoid::identification
