#include <trochoid/identification/identify.h>

#include <trochoid/base/units.h>
#include <trochoid/identification/answer.h>
#include <trochoid/identification/fit_at.h>
#include <trochoid/identification/prepare.h>
#include <trochoid/identification/problem.h>
#include <trochoid/identification/residuals.h>
#include <trochoid/identification/search.h>
#include <trochoid/identification/uncertainty.h>
#include <trochoid/numerics/least_squares.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

std::vector<double> sweep(const force::Setup& setup, const force::Law& law,
                          std::span<const Run> runs, const Fit& fit,
                          std::span<const double> offsets) {
  const auto teeth = static_cast<std::size_t>(setup.cutter.teeth());
  if (runs.empty() || fit.phase.size() != runs.size() || teeth < 2) return {};
  Problem problem;
  problem.setup = setup;
  problem.setup.chip = fit.chip;
  problem.setup.runout = fit.runout;
  problem.law = fit.ok ? fit.law : law;
  problem.columns = static_cast<int>(force::form(law).columns());
  problem.tolerance = 1e-8;
  set_groups(runs, problem);
  double samples = 0.0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    problem.runs.push_back(fold(runs[r], fit.options));
    for (double& angle : problem.runs.back().angle) angle += fit.phase[r];
    samples += static_cast<double>(runs[r].angle.size());
  }
  // What the folded rows no longer hold: the scatter of samples at the same angle.
  double scatter = 0.0;
  for (std::size_t r = 0; r < runs.size(); ++r)
    scatter += scatter_of(runs[r], problem.runs[r]);

  std::vector<double> out;
  for (const double offset : offsets) {
    problem.setup.runout.radial_offsets.resize(teeth, 0.0);
    problem.setup.runout.radial_offsets[1] = offset;
    const Evaluation at = evaluate(problem, {});
    std::vector<double> left = measured(problem);
    const numerics::Columns D = design(problem, at);
    numerics::project_out(D, numerics::gram_of(D), left);
    const double rss = numerics::dot(left, left);
    out.push_back(std::sqrt((rss + scatter) / samples));
  }
  return out;
}

namespace {

using Forces = std::vector<force::Vector3>;

/// Computed forces of a run whose angle of tooth 1 is the recorded angle plus a phase.
class PhasedForces {
 public:
  PhasedForces(const force::Setup& setup, const force::Law& law, const Run& run,
               double tolerance)
      : setup_(setup), law_(law), run_(run), tolerance_(tolerance) {
    setup_.cut = run.cut;
  }

  /// @param stride  every how many samples are looked at
  [[nodiscard]] Forces at(double phase, std::size_t stride = 1) const {
    std::vector<double> phi;
    for (std::size_t i = 0; i < run_.angle.size(); i += stride) {
      phi.push_back(run_.angle[i] + phase);
    }
    return force::forces(setup_, law_, phi, tolerance_);
  }

  [[nodiscard]] double misfit(double phase, std::size_t stride) const {
    const Forces forces = at(phase, stride);
    double sum = 0.0;
    for (std::size_t i = 0; i < forces.size(); ++i) {
      for (std::size_t q = 0; q < 3; ++q) {
        const double d = run_.force[i * stride][q] - forces[i][q];
        sum += d * d;
      }
    }
    return sum;
  }

 private:
  force::Setup setup_;
  force::Law law_;
  const Run& run_;
  double tolerance_;
};

double best_phase(const PhasedForces& forces, std::size_t samples) {
  constexpr int steps = 72;
  const std::size_t stride = std::max<std::size_t>(1, samples / 180);
  double best = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < steps; ++i) {
    const double phase = -unit::turn / 2 + unit::turn * i / steps;
    const double misfit = forces.misfit(phase, stride);
    if (misfit < least) {
      least = misfit;
      best = phase;
    }
  }
  double lo = best - unit::turn / steps;
  double hi = best + unit::turn / steps;
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < 30; ++i) {
    const double a = hi - golden * (hi - lo);
    const double b = lo + golden * (hi - lo);
    const bool right = forces.misfit(a, 1) > forces.misfit(b, 1);
    (right ? lo : hi) = right ? a : b;
  }
  return 0.5 * (lo + hi);
}

}  // namespace

PhaseMatch match_phase(const force::Setup& setup, const force::Law& law, const Run& run,
                       const std::optional<double>& phase, double tolerance) {
  const PhasedForces forces(setup, law, run, tolerance);
  PhaseMatch match;
  match.phase = phase ? *phase : best_phase(forces, run.angle.size());
  match.computed = forces.at(match.phase);
  const double n = static_cast<double>(run.force.size());
  double size = 0.0;
  for (std::size_t i = 0; i < run.force.size(); ++i) {
    for (std::size_t q = 0; q < 3; ++q) {
      const double d = run.force[i][q] - match.computed[i][q];
      match.rms_axis[q] += d * d / n;
      size += run.force[i][q] * run.force[i][q] / n;
    }
  }
  match.rms = std::sqrt(match.rms_axis[0] + match.rms_axis[1] + match.rms_axis[2]);
  for (double& value : match.rms_axis) {
    value = std::sqrt(value);
  }
  match.measured_rms = std::sqrt(size);
  return match;
}

}  // namespace trochoid::identification
