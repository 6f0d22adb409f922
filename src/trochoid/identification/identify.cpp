#include <trochoid/identification/answer.h>
#include <trochoid/identification/fit_at.h>
#include <trochoid/identification/prepare.h>
#include <trochoid/identification/search.h>
#include <trochoid/identification/uncertainty.h>

#include <vector>

namespace trochoid::identification {
namespace {

/// Error of the force matrix while searching, where chips are taken at nodes: they turn out
/// better by far, and a tenth less would cost half as much again.
constexpr double tolerance_at_nodes = 1e-7;

/// Where the edge ends at the axis, or the chip is raised to a power, a quadrature takes
/// part, whose error is not smooth: no derivative bears more than in the last fit.
double search_tolerance(const Problem& problem) {
  const geometry::Profile& profile = problem.setup.cutter.profile;
  const bool nodes = !force::keeps_radius(problem.setup) ||
                     finds_eccentricity(problem.unknowns.runout);
  const bool to_axis = profile.Rr == 0.0 && (profile.R > 0.0 || profile.alpha != 0.0);
  return nodes && !to_axis && !force::form(problem.law).power ? tolerance_at_nodes
                                                              : final_tolerance;
}

}  // namespace

Fit identify(const force::Setup& setup, const force::Law& law,
             std::span<const Run> runs, const Options& options) {
  Fit fit;
  fit.options = options;
  fit.chip = {options.chip_model, setup.chip.lookback};
  fit.law = law;
  fit.coefficients.resize(force::form(law).columns());
  fit.measured = {};
  for (const Run& run : runs) {
    for (std::size_t q = 0; q < 3; ++q) {
      fit.measured[q] = fit.measured[q] || run.measured[q];
    }
  }
  Prepared prepared = prepare(setup, law, runs, options);
  fit.message = prepared.refusal;
  if (!fit.message.empty()) {
    if (prepared.problem) refuse_coefficients(*prepared.problem, fit);
    return fit;
  }
  Problem& problem = *prepared.problem;
  problem.tolerance = search_tolerance(problem);
  Minimum minimum = search(problem);
  if (!minimum.converged) {
    fit.message = "the search for runout and phase did not converge: " + minimum.reason;
    refuse_coefficients(problem, fit);
    return fit;
  }
  restrict_eccentricity(problem, minimum.p);
  problem.tolerance = final_tolerance;
  fill_at(problem, runs, minimum, fit);
  if (setup.cutter.teeth() == 1) refuse_runout_of_one_tooth(fit);
  return fit;
}

}  // namespace trochoid::identification
