#include <trochoid/numerics/secant_levenberg_marquardt.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::numerics {
namespace {

using Dense = Eigen::MatrixXd;
using DenseVector = Eigen::VectorXd;

constexpr double first_damping = 1e-4;  ///< relative to the diagonal of J^T J
constexpr double least_diagonal = 1e-12;
/// A step that gains less than this part of what it promises asks for a new Jacobian.
constexpr double poor_gain = 0.3;
/// So does one that is not this much shorter than the one before.
constexpr double slow = 0.3;
/// A Jacobian counts as that of the minimum within so many parameter tolerances.
constexpr double nearby = 100.0;
/// Where the first step of a Jacobian gains nothing, the damping is at least this.
constexpr double damping_of_failure = 1e-3;
/// So many times what is negligible is near to it: a Jacobian from there still counts, and
/// where a step from there gains nothing, the sum of squares has kinks, between which there
/// is nothing to be gained.
constexpr double nearly_negligible = 100.0;
/// Nearer than this many times, a new Jacobian gets to the end sooner than one kept.
constexpr double near_the_end = 300.0;

/// What is known at the present p.
class Descent {
 public:
  Descent(const Residuals& residuals, int residual_count,
          const std::vector<double>& start, const LevenbergMarquardtOptions& options)
      : residuals_(residuals),
        options_(options),
        p_(Eigen::Map<const DenseVector>(start.data(),
                                         static_cast<Eigen::Index>(start.size()))),
        r_(residual_count),
        r_new_(residual_count),
        J_(residual_count, p_.size()) {}

  LevenbergMarquardtSummary run() {
    LevenbergMarquardtSummary out;
    if (!ask_for_jacobian()) {
      out.p.assign(p_.begin(), p_.end());
      out.reason = "the residuals cannot be evaluated at the start";
      return out;
    }
    out.initial_cost = 0.5 * squares_;
    out.reason = "the iteration limit was reached";
    for (; out.iterations < options_.max_iterations; ++out.iterations) {
      if (const char* const reason = iterate()) {
        out.converged = true;
        out.reason = reason;
        break;
      }
    }
    out.p.assign(p_.begin(), p_.end());
    out.final_cost = 0.5 * squares_;
    return out;
  }

 private:
  [[nodiscard]] double tolerance() const {
    return options_.parameter_tolerance * (p_.norm() + options_.parameter_tolerance);
  }

  /// Whether the Jacobian was asked for close to the present p.
  [[nodiscard]] bool exact() const {
    return (p_ - p_of_J_).norm() <= nearby * tolerance() ||
           gained_ <= nearly_negligible * noise();
  }

  bool ask_for_jacobian() {
    const auto m = static_cast<std::size_t>(r_.size());
    const bool good =
        residuals_({p_.data(), static_cast<std::size_t>(p_.size())}, {r_.data(), m},
                   {J_.data(), static_cast<std::size_t>(J_.size())}) &&
        r_.allFinite();
    if (!good) return false;
    squares_ = r_.squaredNorm();
    p_of_J_ = p_;
    gained_ = 0.0;
    last_step_ = std::numeric_limits<double>::infinity();
    take_products();
    return true;
  }

  void take_products() {
    const Eigen::Index n = J_.cols();
    gram_.resize(n, n);
    downhill_.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index k = 0; k <= i; ++k) {
        gram_(i, k) = gram_(k, i) = J_.col(i).dot(J_.col(k));
      }
      downhill_[i] = -J_.col(i).dot(r_);
    }
  }

  [[nodiscard]] DenseVector step() const {
    Dense damped = gram_;
    damped.diagonal() += damping_ * gram_.diagonal().cwiseMax(least_diagonal);
    return damped.ldlt().solve(downhill_);
  }

  /// Change of the squares that does not count.
  [[nodiscard]] double noise() const {
    const auto freedom = static_cast<double>(r_.size() - p_.size());
    return options_.standard_errors * options_.standard_errors * squares_ /
           std::max(1.0, freedom);
  }

  /// @return whether r_new_ is what p leaves
  bool try_at(const DenseVector& p) {
    return residuals_({p.data(), static_cast<std::size_t>(p.size())},
                      {r_new_.data(), static_cast<std::size_t>(r_new_.size())}, {}) &&
           r_new_.allFinite();
  }

  /// @return why this is the end, or null
  const char* iterate() {
    if (downhill_.cwiseAbs().maxCoeff() < options_.gradient_tolerance) {
      return exact() ? "the gradient vanished" : renew();
    }
    const DenseVector h = step();
    const double length = h.norm();
    const double promised = h.dot(2.0 * downhill_ - gram_ * h);
    const bool little = promised < noise();
    const bool last =
        promised < near_the_end * noise() || length < nearby * tolerance();
    if (last && !exact()) return renew();
    if (!(length >= tolerance())) return "the step became negligible";
    if (little) return "the step became small against its standard error";
    const DenseVector p = p_ + h;
    const double change = try_at(p) ? squares_ - r_new_.squaredNorm()
                                    : -std::numeric_limits<double>::infinity();
    if (!(change > 0.0)) return after_failure(promised, change);
    const bool fresh = p_ == p_of_J_;
    accept(p, h);
    gained_ += promised;
    const double rho = change / promised;
    if (change < options_.function_tolerance && (fresh || rho > poor_gain)) {
      return "the sum of squares no longer changed";
    }
    damping_ *= std::max(0.1, 1.0 - std::pow(2.0 * rho - 1.0, 3));
    growth_ = 2.0;
    if (rho < poor_gain || length > slow * last_step_) return renew();
    last_step_ = length;
    return nullptr;
  }

  /// The step gains nothing: a new Jacobian, or else a shorter step.
  const char* after_failure(double promised, double change) {
    if (p_ != p_of_J_) return renew();
    if (std::abs(change) < options_.function_tolerance ||
        promised < nearly_negligible * noise()) {
      return "the sum of squares no longer changed";
    }
    damping_ = growth_ * std::max(damping_, damping_of_failure);
    growth_ *= 2.0;
    return nullptr;
  }

  /// Take the step, and let the Jacobian learn from it.
  void accept(const DenseVector& p, const DenseVector& h) {
    const DenseVector miss = r_new_ - r_ - J_ * h;
    J_.noalias() += miss * (h / h.squaredNorm()).transpose();
    p_ = p;
    r_.swap(r_new_);
    squares_ = r_.squaredNorm();
    take_products();
  }

  const char* renew() {
    return ask_for_jacobian() ? nullptr : "the residuals cannot be evaluated again";
  }

  const Residuals& residuals_;
  const LevenbergMarquardtOptions& options_;
  DenseVector p_;
  DenseVector r_;
  DenseVector r_new_;
  Dense J_;
  DenseVector p_of_J_;    ///< where the Jacobian was asked for
  Dense gram_;            ///< J^T J
  DenseVector downhill_;  ///< -J^T r
  double squares_ = 0.0;
  double gained_ = 0.0;  ///< of the squares, as promised, since then
  double damping_ = first_damping;
  double growth_ = 2.0;
  double last_step_ = 0.0;
};

}  // namespace

LevenbergMarquardtSummary secant_levenberg_marquardt(
    const Residuals& residuals, int residual_count, const std::vector<double>& start,
    const LevenbergMarquardtOptions& options) {
  return Descent(residuals, residual_count, start, options).run();
}

}  // namespace trochoid::numerics
