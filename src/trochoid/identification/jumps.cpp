#include <trochoid/identification/jumps.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>

namespace trochoid::identification {
namespace {

using base::index;

double spacing(const FoldedRun& run) {
  return unit::turn / static_cast<double>(run.angle.size());
}

/// Best value of one unknown among those within reach of the present one.
void sweep_one(const Problem& problem, std::size_t i, double reach, int steps,
               Minimum& at) {
  std::vector<double> p = at.p;
  const double middle = p[i];
  for (int k = -steps; k <= steps; ++k) {
    p[i] = middle + reach * k / steps;
    const double rss = rss_at(problem, p);
    if (rss < at.rss) {
      at.rss = rss;
      at.p = p;
    }
  }
}

/// One round of a pattern search: every unknown up and down by its step.
bool explore(const Problem& problem, std::span<const double> steps, Minimum& at) {
  bool better = false;
  for (std::size_t i = 0; i < at.p.size(); ++i) {
    for (const double sign : {1.0, -1.0}) {
      std::vector<double> p = at.p;
      p[i] += sign * steps[i];
      const double rss = rss_at(problem, p);
      if (!(rss < at.rss)) continue;
      at.rss = rss;
      at.p = std::move(p);
      better = true;
      break;
    }
  }
  return better;
}

void pattern_search(const Problem& problem, std::vector<double> steps, Minimum& at) {
  for (int round = 0; round < 400; ++round) {
    const std::vector<double> before = at.p;
    if (explore(problem, steps, at)) {
      std::vector<double> ahead = at.p;
      for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] += ahead[i] - before[i];
      const double rss = rss_at(problem, ahead);
      if (rss < at.rss) at = {ahead, rss, true, at.reason};
      continue;
    }
    for (double& s : steps) s *= 0.4;
    if (*std::ranges::max_element(steps) < 1e-7) return;
  }
}

/// Smooth steps; those that a jump makes worse are taken back.
void improve(const Problem& problem, Minimum& at) {
  numerics::LevenbergMarquardtOptions options;
  options.max_iterations = 15;
  options.parameter_tolerance = 1e-8;
  const Minimum smooth = refine(problem, at.p, {1e-5, 1e-6, false}, options);
  if (smooth.rss < at.rss) at = {smooth.p, smooth.rss, true, at.reason};
}

/// Smooth steps from phases within one and a half samples of the present one.
void improve_around(const Problem& problem, std::size_t phase, double cell,
                    Minimum& at) {
  const std::vector<double> middle = at.p;
  for (int k = -6; k <= 6; ++k) {
    Minimum near = at;
    near.p = middle;
    near.p[phase] += cell * k / 4.0;
    near.rss = rss_at(problem, near.p);
    improve(problem, near);
    if (near.rss < at.rss) at = std::move(near);
  }
}

}  // namespace

bool sum_of_squares_jumps(const Problem& problem) {
  if (problem.unknowns.phases == 0) return false;
  return std::ranges::any_of(problem.runs, [&](const FoldedRun& run) {
    return run.turn_map.empty() && enters_suddenly(problem, run, spacing(run));
  });
}

Minimum sweep_phases(const Problem& problem, std::vector<double> start) {
  Minimum at{std::move(start), 0.0, true, "the sweeps no longer changed anything"};
  at.rss = rss_at(problem, at.p);
  const int first_phase = problem.unknowns.first_phase();
  for (int r = 0; r < problem.unknowns.phases; ++r) {
    const double cell = spacing(problem.runs[index(r)]);
    sweep_one(problem, index(first_phase + r), std::max(2.0 * cell, 0.06), 24, at);
  }
  improve(problem, at);
  return at;
}

Minimum refine_by_sweeps(const Problem& problem, std::vector<double> start) {
  Minimum at = sweep_phases(problem, std::move(start));
  const int first_phase = problem.unknowns.first_phase();
  std::vector<double> steps(at.p.size(), 0.02);
  for (int round = 0; round < 4; ++round) {
    const double before = at.rss;
    for (int r = 0; r < problem.unknowns.phases; ++r) {
      const double cell = spacing(problem.runs[index(r)]);
      sweep_one(problem, index(first_phase + r), 2.0 * cell, 16, at);
      steps[index(first_phase + r)] = 0.3 * cell;
    }
    pattern_search(problem, steps, at);
    improve(problem, at);
    for (int r = 0; r < problem.unknowns.phases; ++r) {
      improve_around(problem, index(first_phase + r), spacing(problem.runs[index(r)]),
                     at);
    }
    if (!(at.rss < before * (1.0 - 1e-9))) break;
  }
  return at;
}

}  // namespace trochoid::identification
