#include <trochoid/base/index.h>
#include <trochoid/identification/answer.h>
#include <trochoid/identification/jumps.h>
#include <trochoid/identification/reliability.h>
#include <trochoid/identification/residuals.h>
#include <trochoid/identification/search.h>
#include <trochoid/identification/uncertainty.h>
#include <trochoid/numerics/least_squares.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace trochoid::identification {
namespace {

/// Change of the force over the turn below this part of it says nothing.
constexpr double constant_force = 1e-7;
/// A fit must explain so many times more than it would of noise (the F statistic): with
/// all phases tried, noise alone reaches about 5.
constexpr double least_F = 10.0;

/// Part of the sum of squares of the force that a fit must explain, unless what it
/// leaves is noise.
constexpr double least_explained = 0.1;

/// With fewer equations to spare a fit meets the record in several false minima, and
/// its standard errors mean nothing.
constexpr int spare_equations = 3;

using base::index;

bool finite(const Run& run) {
  const auto good = [](double v) { return std::isfinite(v); };
  return std::ranges::all_of(run.angle, good) &&
         std::ranges::all_of(
             run.force, [&](const auto& f) { return std::ranges::all_of(f, good); });
}

/// What can be refused before any computing; empty: nothing.
std::string refusal(const geometry::Cutter& cutter, std::span<const Run> runs) {
  if (runs.empty()) return "there is no measurement";
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!finite(runs[r])) {
      return fmt::format("measurement {} has values that are not finite", r + 1);
    }
  }
  const auto idle = [&](const Run& run) {
    return !(run.cut.f_z * cutter.teeth() > 0.0) || !(run.cut.a_p > 0.0);
  };
  if (std::ranges::all_of(runs, idle)) {
    return "the feed or the axial depth is zero: nothing is cut, so the forces hold no "
           "information about the material";
  }
  return "";
}

/// Whether the mean forces alone cannot determine the
/// coefficients: one feed, six of them.
bool means_do_not_suffice(const Problem& problem) {
  const double f_z = problem.runs.front().cut.f_z;
  return force::form(problem.law).edge &&
         std::ranges::all_of(problem.runs,
                             [&](const FoldedRun& run) { return run.cut.f_z == f_z; });
}

bool force_is_constant(const Problem& problem) {
  double total = 0.0;
  for (const double b : measured(problem)) total += b * b;
  return rss_of_means(problem) <= constant_force * constant_force * total;
}

/// Whether what the fit explains beyond the means is
/// no more than a fit to noise explains.
bool only_noise(const Problem& problem, const numerics::LeastSquares& linear,
                double variance) {
  const double unknowns = problem.linear() + problem.unknowns.count();
  const double means = 3.0 * static_cast<double>(problem.runs.size());
  return rss_of_means(problem) - linear.rss <
         least_F * std::max(1.0, unknowns - means) * variance;
}

/// A fit that explains next to nothing of a force that is not noise: why, else empty.
std::string nothing_explained(const Fit& fit) {
  const Unexplained& u = fit.unexplained;
  if (u.all * u.all <= 1.0 - least_explained || u.correlation <= noise_correlation) {
    return "";  // I-9
  }
  return fmt::format(
      "the best fit explains {:.1f} % of the force (sum of squares), and what it "
      "leaves is not noise: this record and this tool and cut do not belong together",
      100.0 * (1.0 - u.all * u.all));
}

double samples_of(std::span<const Run> runs) {
  double sum = 0.0;
  for (const Run& run : runs) sum += static_cast<double>(run.angle.size());
  return sum;
}

Unknowns unknowns_of(const force::Setup& setup, const force::Law& law,
                     std::span<const Run> runs, const Options& options) {
  Unknowns out;
  out.teeth = setup.cutter.teeth();
  out.runout =
      chip::feels_runout(options.chip_model) ? options.runout : RunoutUnknowns::none;
  if (out.teeth == 1 && out.runout != RunoutUnknowns::fixed) {
    out.runout = RunoutUnknowns::none;
  }
  out.length = 0.0;
  for (const Run& run : runs) out.length = std::max(out.length, run.cut.f_z);
  out.exponents = options.fit_exponents && force::form(law).power;
  out.phases = options.phase ? 0 : static_cast<int>(runs.size());
  return out;
}

Problem problem_of(const force::Setup& setup, const force::Law& law,
                   std::span<const Run> runs, const Options& options) {
  Problem out;
  out.setup = setup;
  out.setup.chip.model = options.chip_model;
  out.law = law;
  out.unknowns = unknowns_of(setup, law, runs, options);
  if (out.unknowns.runout == RunoutUnknowns::none) out.setup.runout = {};
  for (const Run& run : runs) out.runs.push_back(fold(run, options));
  out.fixed_phase = options.phase.value_or(0.0);
  out.columns = static_cast<int>(force::form(law).columns());
  return out;
}

/// Too few equations for the unknowns: the sentence that says so, else empty.
std::string too_few(const Problem& problem, double equations) {
  const int unknowns = problem.linear() + problem.unknowns.count();
  if (equations >= unknowns + spare_equations) return "";
  return fmt::format("{} equations for {} unknowns: at least {} are needed", equations,
                     unknowns, unknowns + spare_equations);
}

/// Names of the columns of [D] that are zero or depend on one another.
std::string dependent_names(const Problem& problem, const numerics::LeastSquares& fit) {
  const std::vector<std::string> names = names_of(problem);
  const std::size_t n = fit.x.size();
  std::string list;
  for (std::size_t c = 0; c < n; ++c) {
    double part = 0.0;
    for (std::size_t v = c; v < fit.null_space.size(); v += n) {
      part = std::max(part, std::abs(fit.null_space[v]));
    }
    if (part > 1e-3) list += (list.empty() ? "" : ", ") + names[c];
  }
  return list;
}

/// [D] without its channel columns.
std::vector<double> force_columns(const Problem& problem, std::span<const double> D) {
  const std::size_t linear = index(problem.linear());
  const std::size_t columns = index(problem.columns);
  std::vector<double> out;
  out.reserve(D.size() / linear * columns);
  for (std::size_t row = 0; row < D.size(); row += linear) {
    out.insert(out.end(), D.begin() + static_cast<std::ptrdiff_t>(row),
               D.begin() + static_cast<std::ptrdiff_t>(row + columns));
  }
  return out;
}

/// Coefficients that cannot be told apart from one another refuse the fit. One that
/// only an unknown channel offset hides is absent, and the others stand.
std::string rank_refusal(const Problem& problem, std::span<const double> D,
                         const numerics::LeastSquares& all) {
  if (all.rank == problem.linear()) return "";
  const numerics::LeastSquares force = numerics::least_squares(
      force_columns(problem, D), problem.columns, measured(problem), rank_tolerance);
  if (*std::ranges::max_element(force.norms) == 0.0) {
    return "nothing is in cut at any of the measured angles";
  }
  if (force.rank == problem.columns) return "";
  return fmt::format(
      "the forces determine only {} of {} coefficients: {} cannot be told apart",
      force.rank, problem.columns, dependent_names(problem, force));
}

/// Where only one component of the eccentricity shows, search that one alone.
void restrict_eccentricity(Problem& problem, std::vector<double>& p) {
  if (problem.unknowns.runout != RunoutUnknowns::eccentricity) return;
  const Point point = point_of(problem, p);
  const Problem coarse = coarse_problem(problem);
  std::vector<double> residual = measured(coarse);
  const std::vector<double> K = numerics::project_out(
      design(coarse, evaluate(coarse, p)), coarse.linear(), residual, 1);
  problem.unknowns.direction = single_direction(coarse, p, K);
  if (!problem.unknowns.direction) return;
  p = settle(problem, parameters_of(problem, point)).p;
}

/// The fit at the minimum, with all its numbers; `fit.ok` tells whether they stand.
void answer_at(const Problem& problem, std::span<const Run> runs,
               const std::vector<double>& p, Fit& fit) {
  const Evaluation at = evaluate(problem, p);
  const std::vector<double> D = design(problem, at);
  const numerics::LeastSquares linear =
      numerics::least_squares(D, problem.linear(), measured(problem), rank_tolerance);
  fit.rank = linear.rank;
  fit.condition = linear.condition;
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
  const double equations = equations_of(problem, runs);
  const double rss = fit.rms * fit.rms * samples_of(runs);
  const Uncertainty known = uncertainty(problem, p, linear.x, rss, equations);
  if (means_do_not_suffice(problem) &&
      only_noise(problem, linear, rss / known.freedom)) {
    fit.message =
        "this model explains no more of how the force changes over the turn than it "
        "would of noise; the three means alone cannot determine six coefficients";
    refuse_coefficients(problem, fit);
    return;
  }
  fill_estimates(problem, p, linear.x, known, fit);
  fit.ok = std::ranges::any_of(fit.coefficients, [](const auto& K) { return !!K; });
  if (!fit.ok) fit.message = "none of the coefficients can be told from the record";
}

}  // namespace

Fit identify(const force::Setup& setup, const force::Law& law,
             std::span<const Run> runs, const Options& options) {
  Fit fit;
  fit.options = options;
  fit.chip = {options.chip_model, setup.chip.lookback};
  fit.law = law;
  fit.coefficients.resize(force::form(law).columns());
  fit.message = refusal(setup.cutter, runs);
  if (!fit.message.empty()) return fit;
  Problem problem = problem_of(setup, law, runs, options);
  fit.message = too_few(problem, equations_of(problem, runs));
  if (fit.message.empty() && means_do_not_suffice(problem) &&
      force_is_constant(problem)) {
    fit.message =
        "the force does not change with the angle: its three means are all that the "
        "record tells, and they cannot determine six coefficients";
  }
  if (!fit.message.empty()) {
    refuse_coefficients(problem, fit);
    return fit;
  }
  problem.tolerance = final_tolerance;
  Minimum minimum = search(problem);
  if (!minimum.converged) {
    fit.message = "the search for runout and phase did not converge: " + minimum.reason;
    refuse_coefficients(problem, fit);
    return fit;
  }
  restrict_eccentricity(problem, minimum.p);
  answer_at(problem, runs, minimum.p, fit);
  if (setup.cutter.teeth() == 1) refuse_runout_of_one_tooth(fit);
  return fit;
}

}  // namespace trochoid::identification
