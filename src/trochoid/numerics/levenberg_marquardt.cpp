#include <trochoid/numerics/levenberg_marquardt.h>

#include <trochoid/numerics/least_squares.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace trochoid::numerics {
namespace {

using Dense = Eigen::MatrixXd;
using DenseVector = Eigen::VectorXd;

/// A residual whose square is still finite, and worse than any other.
constexpr double out_of_range = 1e140;
constexpr double damping_at_start = 1e-4;
/// Damping is relative to the diagonal of J^T J, which is taken no smaller and no larger.
constexpr double smallest_diagonal = 1e-6;
constexpr double largest_diagonal = 1e32;
/// A good step lowers the damping at most to this fraction.
constexpr double most_relief = 1.0 / 3.0;

/// r(p), and J where it is asked for; out of range where r cannot be evaluated.
bool evaluate(const Residuals& residuals, const DenseVector& p, DenseVector& r,
              Dense* J) {
  const auto m = static_cast<std::size_t>(r.size());
  const std::span<double> out(r.data(), m);
  const std::span<double> slopes(
      J == nullptr ? nullptr : J->data(),
      J == nullptr ? 0 : m * static_cast<std::size_t>(p.size()));
  const bool good =
      residuals({p.data(), static_cast<std::size_t>(p.size())}, out, slopes) &&
      std::ranges::all_of(out, [](double v) { return std::isfinite(v); });
  if (!good) std::ranges::fill(out, out_of_range / std::sqrt(static_cast<double>(m)));
  return good;
}

/// The residuals near p as a linear function, its columns scaled.
struct Linearized {
  DenseVector p;
  DenseVector scale;  ///< of the columns, as they were at the start
  Dense gram;         ///< J^T J
  DenseVector downhill;
  double cost = 0.0;  ///< |r|^2/2

  [[nodiscard]] double steepest() const { return downhill.array().abs().maxCoeff(); }
};

/// @return whether r can be evaluated at `near.p`
bool linearize(const Residuals& residuals, Eigen::Index m, Linearized& near) {
  DenseVector r(m);
  Dense J(m, near.p.size());
  if (!evaluate(residuals, near.p, r, &J)) return false;
  if (near.scale.size() == 0) near.scale = 1.0 / (1.0 + J.colwise().norm().array());
  J = J * near.scale.asDiagonal();
  near.gram = J.transpose() * J;
  near.downhill = J.transpose() * -r;
  near.cost = r.squaredNorm() / 2;
  return true;
}

DenseVector damped_step(const Linearized& near, double damping) {
  Dense damped = near.gram;
  for (Eigen::Index i = 0; i < damped.rows(); ++i) {
    // By a root and its square: the last digit of a fit is pinned by the tests.
    const double d =
        std::sqrt(damping * std::min(std::max(near.gram(i, i), smallest_diagonal),
                                     largest_diagonal));
    damped(i, i) += d * d;
  }
  return Eigen::LDLT<Dense>(damped).solve(near.downhill);
}

struct Damping {
  double value = damping_at_start;
  double growth = 2;  ///< after the next step that fails
};

/// One step.
/// @return why it was the last, or null
const char* iterate(const Residuals& residuals,
                    const LevenbergMarquardtOptions& options, Linearized& near,
                    DenseVector& r, Damping& damping) {
  const DenseVector step = damped_step(near, damping.value);
  const DenseVector dx = near.scale.asDiagonal() * step;
  const double least =
      options.parameter_tolerance * (near.p.norm() + options.parameter_tolerance);
  if (dx.norm() < least) return "the step became negligible";
  const DenseVector p = near.p + dx;
  evaluate(residuals, p, r, nullptr);
  const double change = 2 * near.cost - r.squaredNorm();
  const double promised = step.dot(2 * near.downhill - near.gram * step);
  const bool negligible = std::abs(change) < options.function_tolerance;
  const char* const unchanged = "the sum of squares no longer changed";
  const double rho = change / promised;
  if (!(rho > 0)) {
    damping.value *= damping.growth;
    damping.growth *= 2;
    return negligible ? unchanged : nullptr;
  }
  near.p = p;
  if (negligible) {
    near.cost = r.squaredNorm() / 2;
    return unchanged;
  }
  linearize(residuals, r.size(), near);  // where J cannot be had, the last one serves
  if (near.steepest() < options.gradient_tolerance) return "the gradient vanished";
  const double miss = 2 * rho - 1;
  damping.value *= std::max(most_relief, 1 - miss * miss * miss);
  damping.growth = 2;
  return nullptr;
}

}  // namespace

LevenbergMarquardtSummary levenberg_marquardt(
    const Residuals& residuals, int residual_count, std::vector<double> start,
    const LevenbergMarquardtOptions& options) {
  LevenbergMarquardtSummary out;
  Linearized near;
  near.p = Eigen::Map<const DenseVector>(start.data(),
                                         static_cast<Eigen::Index>(start.size()));
  out.p = std::move(start);
  if (!linearize(residuals, residual_count, near)) {
    out.reason = "the residuals cannot be evaluated at the start";
    return out;
  }
  out.initial_cost = near.cost;
  const char* reason =
      near.steepest() < options.gradient_tolerance ? "the gradient vanished" : nullptr;
  DenseVector r(residual_count);
  Damping damping;
  while (reason == nullptr && ++out.iterations < options.max_iterations) {
    reason = iterate(residuals, options, near, r, damping);
  }
  out.p.assign(near.p.begin(), near.p.end());
  out.final_cost = near.cost;
  out.converged = reason != nullptr;
  out.reason = out.converged ? reason : "the iteration limit was reached";
  return out;
}

std::vector<double> covariance_at(const Residuals& residuals, int residual_count,
                                  std::span<const double> p, double cost,
                                  double rank_tolerance) {
  const auto m = static_cast<std::size_t>(residual_count);
  std::vector<double> r(m);
  std::vector<double> columns(m * p.size());
  residuals(p, r, columns);
  const std::vector<double> nothing(m, 0.0);  // only the columns count
  std::vector<double> C = least_squares(by_rows(columns, m), static_cast<int>(p.size()),
                                        nothing, rank_tolerance)
                              .inverse_gram;
  for (double& value : C) value *= 2 * cost / static_cast<double>(m - p.size());
  return C;
}

}  // namespace trochoid::numerics
