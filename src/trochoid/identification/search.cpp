#include <trochoid/base/units.h>
#include <trochoid/identification/jumps.h>
#include <trochoid/identification/scan.h>
#include <trochoid/identification/search.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::identification {
namespace {

constexpr int coarse_bins = 120;

bool equal_pitch(const geometry::Cutter& cutter) {
  const double pitch = unit::turn / cutter.teeth();
  return std::ranges::all_of(cutter.pitch,
                             [&](double p) { return std::abs(p - pitch) < 1e-9; });
}

bool equal_offsets(const geometry::Runout& runout) {
  const auto& s = runout.radial_offsets;
  return std::ranges::all_of(s, [&](double v) { return v == s.front(); });
}

bool nearly_equal(const Minimum& a, const Minimum& b) {
  double distance = 0.0;
  for (std::size_t i = 0; i < a.p.size(); ++i) {
    distance = std::max(distance, std::abs(a.p[i] - b.p[i]));
  }
  return distance < 1e-3;
}

constexpr Step coarse_step{1e-3, 1e-3, false};

numerics::LevenbergMarquardtOptions coarse_options() {
  numerics::LevenbergMarquardtOptions out;
  out.max_iterations = 25;
  out.parameter_tolerance = 1e-4;
  out.function_tolerance = 1e-7;
  return out;
}

/// The best place on a line through one offset, the others kept.
std::vector<double> best_on_line(const Problem& coarse, std::vector<double> p,
                                 std::size_t i) {
  std::vector<double> best = p;
  double least = std::numeric_limits<double>::infinity();
  const double here = p[i];
  for (int k = -4; k <= 4; ++k) {
    if (k == 0) continue;
    p[i] = here + 0.3 * k;
    const double rss = rss_at(coarse, p);
    if (rss < least) {
      least = rss;
      best = p;
    }
  }
  return best;
}

/// Leave a local minimum in which one tooth is wrong: a tooth that hardly cuts hides
/// where its offset should go.
void move_single_teeth(const Problem& coarse, Minimum& best) {
  if (coarse.unknowns.runout != RunoutUnknowns::offsets) return;
  const auto count = static_cast<std::size_t>(coarse.unknowns.runout_count());
  if (count < 2 || count > 11) return;
  bool better = true;
  for (int round = 0; better && round < 3; ++round) {
    better = false;
    for (std::size_t i = 0; i < count; ++i) {
      Minimum m = refine(coarse, best_on_line(coarse, best.p, i), coarse_step,
                         coarse_options());
      if (!(m.rss < 0.999 * best.rss)) continue;
      best = std::move(m);
      better = true;
    }
  }
}

/// Local minima from the best candidates, the best first.
std::vector<Minimum> coarse_minima(const Problem& coarse,
                                   const std::vector<Candidate>& candidates) {
  const std::size_t starts = coarse.unknowns.runout_count() > 2 ? 6 : 3;
  std::vector<Minimum> out;
  for (std::size_t i = 0; i < std::min(starts, candidates.size()); ++i) {
    Minimum m = refine(coarse, candidates[i].p, coarse_step, coarse_options());
    apply_gauge(coarse, m.p);
    const bool known = std::ranges::any_of(
        out, [&](const Minimum& other) { return nearly_equal(m, other); });
    if (!known) out.push_back(std::move(m));
  }
  std::ranges::stable_sort(out, {}, &Minimum::rss);
  move_single_teeth(coarse, out.front());
  return out;
}

}  // namespace

Problem coarse_problem(const Problem& problem) {
  Problem out = problem;
  for (FoldedRun& run : out.runs) run = coarsen(run, coarse_bins);
  out.tolerance = std::max(problem.tolerance, 1e-6);
  return out;
}

Minimum settle(const Problem& problem, const std::vector<double>& start) {
  if (sum_of_squares_jumps(problem)) return refine_by_sweeps(problem, start);
  numerics::LevenbergMarquardtOptions options;
  options.max_iterations = 40;
  options.parameter_tolerance = 1e-7;
  options.function_tolerance = 1e-24;
  Minimum out = refine(problem, start, {}, options);
  if (out.converged) return out;
  // Kinks of the sum of squares can keep the steps from vanishing; what counts is that
  // they no longer gain anything.
  Minimum again = refine(problem, out.p, {}, options);
  again.converged = again.converged || again.rss > out.rss * (1.0 - 1e-6);
  return again;
}

bool teeth_are_alike(const Problem& problem) {
  const Unknowns& u = problem.unknowns;
  if (u.phases == 0 || !equal_pitch(problem.setup.cutter)) return false;
  const geometry::Runout& given = problem.setup.runout;
  if (u.runout == RunoutUnknowns::offsets) return given.eccentricity == 0.0;
  if (u.runout == RunoutUnknowns::eccentricity) return equal_offsets(given);
  return given.eccentricity == 0.0 && equal_offsets(given);
}

bool apply_gauge(const Problem& problem, std::vector<double>& p) {
  const Unknowns& u = problem.unknowns;
  if (u.phases == 0) return false;
  Point point = point_of(problem, p);
  const double pitch = unit::turn / u.teeth;
  int shift = 0;
  if (teeth_are_alike(problem)) {
    const auto passed = static_cast<int>(std::floor(point.phase[0] / pitch + 0.5));
    shift = ((passed % u.teeth) + u.teeth) % u.teeth;
    for (double& phase : point.phase) phase -= passed * pitch;
  }
  if (u.runout == RunoutUnknowns::offsets && shift != 0) {
    auto& s = point.runout.radial_offsets;
    std::ranges::rotate(s, s.begin() + shift);
  }
  point.runout.angle -= shift * pitch;
  for (std::size_t r = 0; r < point.phase.size(); ++r) {
    double& phase = point.phase[r];
    if (r > 0 || !teeth_are_alike(problem))
      phase -= unit::turn * std::floor(phase / unit::turn + 0.5);
  }
  p = parameters_of(problem, point);
  return shift != 0;
}

Minimum search(const Problem& problem) {
  const Unknowns& u = problem.unknowns;
  if (u.count() == 0) return refine(problem, {}, {}, {});
  const double span = teeth_are_alike(problem) ? unit::turn / u.teeth : unit::turn;
  const Problem coarse = coarse_problem(problem);
  const std::vector<Candidate> candidates = scan(coarse, span);
  if (candidates.empty()) return {{}, 0.0, false, "no start gives a force"};
  Minimum best;
  if (sum_of_squares_jumps(problem)) {
    std::vector<Minimum> swept;
    for (std::size_t i = 0; i < std::min<std::size_t>(4, candidates.size()); ++i) {
      swept.push_back(sweep_phases(problem, candidates[i].p));
    }
    std::ranges::stable_sort(swept, {}, &Minimum::rss);
    best = refine_by_sweeps(problem, swept.front().p);
    if (swept.size() > 1 && swept[1].rss < 4.0 * best.rss) {
      Minimum second = refine_by_sweeps(problem, swept[1].p);
      if (second.rss < best.rss) best = std::move(second);
    }
    apply_gauge(problem, best.p);
    return best;
  }
  const std::vector<Minimum> minima = coarse_minima(coarse, candidates);
  best = settle(problem, minima.front().p);
  if (minima.size() > 1 && minima[1].rss < 1.02 * minima[0].rss) {
    Minimum second = settle(problem, minima[1].p);
    if (second.rss < best.rss) best = std::move(second);
  }
  // Renumbering changes the common part of the offsets, which has a slight effect.
  if (apply_gauge(problem, best.p)) best = settle(problem, best.p);
  return best;
}

}  // namespace trochoid::identification
