#include <trochoid/identification/answer.h>
#include <trochoid/identification/fit_at.h>
#include <trochoid/identification/prepare.h>
#include <trochoid/identification/search.h>
#include <trochoid/identification/uncertainty.h>

#include <vector>

namespace trochoid::identification {
Fit identify(const force::Setup& setup, const force::Law& law,
             std::span<const Run> runs, const Options& options) {
  Fit fit;
  fit.options = options;
  fit.chip = {options.chip_model, setup.chip.lookback};
  fit.law = law;
  fit.coefficients.resize(force::form(law).columns());
  Prepared prepared = prepare(setup, law, runs, options);
  fit.message = prepared.refusal;
  if (!fit.message.empty()) {
    if (prepared.problem) refuse_coefficients(*prepared.problem, fit);
    return fit;
  }
  Problem& problem = *prepared.problem;
  problem.tolerance = final_tolerance;
  Minimum minimum = search(problem);
  if (!minimum.converged) {
    fit.message = "the search for runout and phase did not converge: " + minimum.reason;
    refuse_coefficients(problem, fit);
    return fit;
  }
  restrict_eccentricity(problem, minimum.p);
  fill_at(problem, runs, minimum, fit);
  if (setup.cutter.teeth() == 1) refuse_runout_of_one_tooth(fit);
  return fit;
}

}  // namespace trochoid::identification
