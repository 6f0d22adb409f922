#include <ceres/tiny_solver.h>
#include <trochoid/numerics/levenberg_marquardt.h>

#include <algorithm>
#include <cmath>

namespace trochoid::numerics {
namespace {

/// A residual whose square is still finite, and worse than any other.
constexpr double out_of_range = 1e140;

/// The problem in the form that the solver asks for.
struct Adapter {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Eigen::Dynamic };

  const Residuals& residuals;
  int residual_count;
  int parameter_count;

  // The solver fixes the names of these two.
  [[nodiscard]] int NumResiduals() const {  // NOLINT(readability-identifier-naming)
    return residual_count;
  }
  [[nodiscard]] int NumParameters() const {  // NOLINT(readability-identifier-naming)
    return parameter_count;
  }

  bool operator()(const double* p, double* r, double* jacobian) const {
    const auto m = static_cast<std::size_t>(residual_count);
    const auto n = static_cast<std::size_t>(parameter_count);
    const std::span<double> out(r, m);
    const std::span<double> slopes(jacobian, jacobian == nullptr ? 0 : m * n);
    const bool good =
        residuals({p, n}, out, slopes) &&
        std::ranges::all_of(out, [](double v) { return std::isfinite(v); });
    if (!good) std::ranges::fill(out, out_of_range / std::sqrt(static_cast<double>(m)));
    return good;
  }
};

using Solver = ceres::TinySolver<
    Adapter, Eigen::LDLT<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>>>;

std::string words(Solver::Status status) {
  switch (status) {
    case Solver::GRADIENT_TOO_SMALL:
      return "the gradient vanished";
    case Solver::RELATIVE_STEP_SIZE_TOO_SMALL:
      return "the step became negligible";
    case Solver::COST_TOO_SMALL:
      return "the residual vanished";
    case Solver::COST_CHANGE_TOO_SMALL:
      return "the sum of squares no longer changed";
    case Solver::HIT_MAX_ITERATIONS:
      break;
  }
  return "the iteration limit was reached";
}

}  // namespace

LevenbergMarquardtSummary levenberg_marquardt(
    const Residuals& residuals, int residual_count, std::vector<double> start,
    const LevenbergMarquardtOptions& options) {
  LevenbergMarquardtSummary out;
  const Adapter adapter{residuals, residual_count, static_cast<int>(start.size())};
  Eigen::VectorXd p = Eigen::Map<Eigen::VectorXd>(
      start.data(), static_cast<Eigen::Index>(start.size()));
  Eigen::VectorXd first(residual_count);
  out.p = std::move(start);
  if (!adapter(p.data(), first.data(), nullptr)) {
    out.reason = "the residuals cannot be evaluated at the start";
    return out;
  }
  Solver solver;
  solver.options.max_num_iterations = options.max_iterations;
  solver.options.gradient_tolerance = options.gradient_tolerance;
  solver.options.parameter_tolerance = options.parameter_tolerance;
  solver.options.function_tolerance = options.function_tolerance;
  solver.options.cost_threshold = 0.0;
  const auto& summary = solver.Solve(adapter, &p);
  out.p.assign(p.data(), p.data() + p.size());
  out.initial_cost = summary.initial_cost;
  out.final_cost = summary.final_cost;
  out.iterations = summary.iterations;
  out.converged = summary.status != Solver::HIT_MAX_ITERATIONS;
  out.reason = words(summary.status);
  return out;
}

}  // namespace trochoid::numerics
