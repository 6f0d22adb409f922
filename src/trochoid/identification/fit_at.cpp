#include <trochoid/identification/fit_at.h>

#include <trochoid/base/index.h>
#include <trochoid/identification/answer.h>
#include <trochoid/identification/prepare.h>
#include <trochoid/identification/reliability.h>
#include <trochoid/identification/uncertainty.h>
#include <trochoid/numerics/least_squares.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trochoid::identification {
namespace {

/// A fit must explain so many times more than it would of noise (the F statistic): with
/// all phases tried, noise alone reaches about 5.
constexpr double least_F = 10.0;

/// Part of the sum of squares of the force that a fit must explain, unless what it
/// leaves is noise.
constexpr double least_explained_force = 0.1;

using base::index;

/// Whether what the fit explains beyond the means is
/// no more than a fit to noise explains.
bool only_noise(const Problem& problem, const numerics::LeastSquares& linear,
                double variance) {
  const double unknowns = linear.rank + problem.unknowns.count();
  double means = 0.0;
  for (const FoldedRun& run : problem.runs) means += measured_count(run);
  return rss_of_means(problem) - linear.rss <
         least_F * std::max(1.0, unknowns - means) * variance;
}

/// A fit that explains next to nothing of a force that is not noise: why, else empty.
std::string nothing_explained(const Fit& fit) {
  const Unexplained& u = fit.unexplained;
  // Beyond its band a fit through resonances says what a lightly damped one makes of it.
  const double left = fit.options.response.empty() ? u.all : u.in_band;
  if (left * left <= 1.0 - least_explained_force ||
      u.correlation <= noise_correlation) {
    return "";  // I-9
  }
  return fmt::format(
      "the best fit explains {:.1f} % of the force (sum of squares), and what it "
      "leaves is not noise: this record and this tool and cut do not belong together",
      100.0 * (1.0 - left * left));
}

double samples_of(std::span<const Run> runs) {
  double sum = 0.0;
  for (const Run& run : runs) sum += static_cast<double>(run.angle.size());
  return sum;
}

/// Names of the columns of [D] that are zero or depend on one another.
std::string dependent_names(const Problem& problem, const numerics::LeastSquares& fit,
                            std::span<const std::string> unmeasured) {
  const std::vector<std::string> names = names_of(problem);
  const std::size_t n = fit.x.size();
  std::string list;
  for (std::size_t c = 0; c < n; ++c) {
    if (!unmeasured[c].empty()) continue;
    double part = 0.0;
    for (std::size_t v = c; v < fit.null_space.size(); v += n) {
      part = std::max(part, std::abs(fit.null_space[v]));
    }
    if (part > 1e-3) list += (list.empty() ? "" : ", ") + names[c];
  }
  return list;
}

/// Condition of [D] without the columns that are zero for want of a channel.
double condition_of(const Problem& problem, const numerics::Columns& D,
                    const numerics::LeastSquares& all) {
  const std::vector<std::string> unmeasured = unmeasured_reasons(problem, D);
  std::vector<double> rest;
  for (std::size_t c = 0; c < D.count(); ++c) {
    if (unmeasured[c].empty()) rest.insert(rest.end(), D[c].begin(), D[c].end());
  }
  if (rest.empty() || rest.size() == D.count() * D.rows) return all.condition;
  return numerics::least_squares({rest, D.rows}, measured(problem), rank_tolerance)
      .condition;
}

}  // namespace

std::string rank_refusal(const Problem& problem, const numerics::Columns& D,
                         const numerics::LeastSquares& all) {
  if (all.rank == problem.linear()) return "";
  const std::vector<std::string> unmeasured = unmeasured_reasons(problem, D);
  const auto told = [&](int columns) {  // of the first so many
    return static_cast<int>(
        std::count(unmeasured.begin(), unmeasured.begin() + columns, std::string()));
  };
  if (all.rank == told(problem.linear())) return "";
  const numerics::LeastSquares force = numerics::least_squares(
      D.first(index(problem.force_columns())), measured(problem), rank_tolerance);
  if (*std::ranges::max_element(force.norms) == 0.0) {
    return "nothing is in cut at any of the measured angles";
  }
  const int wanted = told(problem.force_columns());
  if (force.rank == wanted) return "";
  return fmt::format(
      "the forces determine only {} of {} coefficients: {} cannot be determined "
      "separately",
      force.rank, wanted, dependent_names(problem, force, unmeasured));
}

Leftover leftover_of(const Problem& problem, std::span<const Run> runs, const Fit& fit,
                     std::span<const double> rows) {
  Leftover left{
      fit.rms * fit.rms * samples_of(runs), equations_of(problem, runs), {}, {}, {}};
  if (fit.options.errors == Errors::automatic) {
    left.runs = runs;
    left.fitted = fit.fitted;
    left.rows = rows;
  }
  return left;
}

void fill_at(const Problem& problem, std::span<const Run> runs, Minimum& minimum,
             Fit& fit) {
  const std::vector<double>& p = minimum.p;
  Evaluation at = minimum.at && serves(problem, *minimum.at, p) ? std::move(*minimum.at)
                                                                : evaluate(problem, p);
  minimum.at.reset();
  const numerics::Columns D = design(problem, at);
  const numerics::LeastSquares linear =
      numerics::least_squares(D, measured(problem), rank_tolerance);
  fit.rank = linear.rank;
  fit.condition = linear.rank == problem.linear() ? linear.condition
                                                  : condition_of(problem, D, linear);
  fit.message = rank_refusal(problem, D, linear);
  if (!fit.message.empty()) {
    refuse_coefficients(problem, fit);
    return;
  }
  fill_fitted(problem, runs, at, linear, fit);
  fit.message = nothing_explained(fit);
  if (!fit.message.empty()) {
    refuse_coefficients(problem, fit);
    return;
  }
  const Leftover left = leftover_of(problem, runs, fit, linear.residual);
  const Uncertainty known = uncertainty(problem, std::move(at), linear.x, left);
  if (means_do_not_suffice(problem) &&
      only_noise(problem, linear, left.rss / known.freedom)) {
    fit.message =
        "this model explains the change of the force over a turn no better than it "
        "would explain noise; the three mean forces alone cannot determine six "
        "coefficients";
    refuse_coefficients(problem, fit);
    return;
  }
  fill_estimates(problem, p, linear.x, known, fit);
  fit.ok = std::ranges::any_of(fit.groups, [](const Group& group) {
    return std::ranges::any_of(group.coefficients, [](const auto& K) { return !!K; });
  });
  if (!fit.ok) fit.message = "the record determines none of the coefficients";
}

}  // namespace trochoid::identification
