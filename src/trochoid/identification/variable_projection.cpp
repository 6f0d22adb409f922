#include <trochoid/identification/variable_projection.h>
#include <trochoid/numerics/columns.h>
#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/secant_levenberg_marquardt.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace trochoid::identification {
namespace {

double squared(std::span<const double> v) {
  return std::inner_product(v.begin(), v.end(), v.begin(), 0.0);
}

/// Everything known at one p.
struct State {
  bool known = false;
  Evaluation at;
  std::vector<double> gram;  ///< of [D]
  std::vector<double> K;
  std::vector<double> residual;
};

/// @param[in,out] out  elsewhere, of which what is the same and the memory serve again
/// @return whether there is a force at p
bool fill_state(const Problem& problem, std::span<const double> p, State& out) {
  if (!in_range(problem, p)) return false;
  out.known = false;
  try {
    evaluate(problem, p, out.at);
  } catch (const std::invalid_argument&) {
    out.at.matrix.clear();  // a cutter that cannot be, such as a radius below zero
    return false;
  }
  const numerics::Columns D = design(problem, out.at);
  out.gram.resize(D.count() * D.count());
  numerics::inner_products(D, D, out.gram);
  out.residual.clear();
  for (const FoldedRun& run : problem.runs) {
    out.residual.insert(out.residual.end(), run.b.begin(), run.b.end());
  }
  out.K = numerics::project_out(D, out.gram, out.residual);
  out.known = true;
  return true;
}

/// Of each channel between one angle and the next, where rows are angles.
double correlation(std::span<const double> residual) {
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t i = 3; i < residual.size(); ++i) {
    products += residual[i] * residual[i - 3];
    squares += residual[i] * residual[i];
  }
  return squares > 0.0 ? products / squares : 0.0;
}

/// Derivatives of the residual: column-major, shape (rows, unknowns).
void fill_jacobian(const Problem& problem, const State& state, const Step& step,
                   std::span<double> jacobian) {
  const auto rows = static_cast<std::size_t>(problem.rows());
  const Derivatives derivatives(problem, state.at, state.K);
  for (int i = 0; i < problem.unknowns.count(); ++i) {
    derivatives.find(i, step,
                     jacobian.subspan(static_cast<std::size_t>(i) * rows, rows));
  }
  numerics::project_out(design(problem, state.at), state.gram, jacobian);
}

/// Residuals over their scale, for a search; the last place is known.
class ScaledResiduals {
 public:
  ScaledResiduals(const Problem& problem, const Step& step, double scale)
      : problem_(problem), step_(step), scale_(scale) {}

  bool operator()(std::span<const double> p, std::span<double> r,
                  std::span<double> jacobian) {
    const State* const here = last_.known && problem_.stop.exhausted()
                                  ? nullptr
                                  : find(p);  // no further step
    if (here == nullptr) return false;
    std::ranges::transform(here->residual, r.begin(),
                           [&](double v) { return v / scale_; });
    if (jacobian.empty()) return true;
    fill_jacobian(problem_, *here, step_, jacobian);
    for (double& j : jacobian) j /= -scale_;
    return true;
  }

  /// The state at p, or null.
  State* find(std::span<const double> p) {
    const bool there = last_.known && std::ranges::equal(last_.at.p, p);
    return there || fill_state(problem_, p, last_) ? &last_ : nullptr;
  }

 private:
  const Problem& problem_;
  Step step_;
  double scale_;
  State last_;
};

}  // namespace

double rss_at(const Problem& problem, std::span<const double> p) {
  Evaluation last;
  return rss_at(problem, p, last);
}

double rss_at(const Problem& problem, std::span<const double> p, Evaluation& last) {
  State state;
  state.at = std::move(last);
  const bool good = fill_state(problem, p, state);
  last = std::move(state.at);
  return good ? squared(state.residual) : std::numeric_limits<double>::infinity();
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
  ScaledResiduals residuals(problem, step, scale);
  const auto summary = numerics::secant_levenberg_marquardt(
      std::ref(residuals), problem.rows(), out.p, options);
  out.p = summary.p;
  out.rss = 2.0 * summary.final_cost * scale * scale;
  out.converged = summary.converged;
  out.reason = summary.reason;
  if (problem.stop.exhausted()) {
    out.converged = false;
    out.reason = "it takes too much work; --anyway goes on";
  }
  if (State* const end = residuals.find(out.p)) {
    out.correlation = correlation(end->residual);
    out.at = std::make_shared<Evaluation>(std::move(end->at));
  }
  return out;
}

}  // namespace trochoid::identification
