#include <trochoid/identification/local_minimum.h>
#include <trochoid/identification/problem.h>
#include <trochoid/identification/runout_starts.h>
#include <trochoid/identification/search.h>
#include <trochoid/identification/uncertainty.h>
#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace trochoid::identification {
namespace {

// The sum of squares has many minima over runout and phases: a phase that is off by a pitch
// renumbers the teeth, and a tooth that hardly cuts says little of its offset. So the search
// goes from cheap to dear. A scan (I-12) ranks runouts and phases. Levenberg-Marquardt runs
// from the best few on data averaged over the turn with a coarse force matrix; there the two
// kinds of wrong minima are left as well (move_single_teeth, renumber). Only the best minimum,
// and a second one that all but ties with it, is followed on all of the data.
//
// Edges without lag that carry an edge force enter all at once: the sum of squares then jumps
// whenever an edge passes a sample, and no derivative leads across. A smooth problem nearby
// gives the starts, and the last part compares the places between the jumps.

constexpr int coarse_bins = 120;
constexpr int coarse_angles = 64;
/// A second minimum this near to the first is followed to its end as well.
constexpr double near_tie = 1.02;
/// A tooth somewhere else that leaves so many times more is not where it belongs.
constexpr double hopeless = 10.0;
/// Two coarse minima nearer to one another than this are one.
constexpr double same_minimum = 5e-3;
/// The last steps are as small as this against a standard error: what kinks of the sum
/// of squares allow.
constexpr double last_step = 1e-4;
/// Candidates that are enough to rank problems.
constexpr std::size_t starts_to_rank = 2;
constexpr auto no_start = "no start gives a force";

/// A given start counts where the fit stays this near to its runout, in feeds, and
/// leaves no more than this part of how the force changes (rms).
constexpr double near_start = 0.3;
constexpr double little_left = 0.3;
/// The correlation of so much white noise is larger than this over the root of its
/// length in one case of 40.
constexpr double white = 2.0;

bool nearly_equal(const std::vector<double>& a, const std::vector<double>& b,
                  double distance) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(std::abs(a[i] - b[i]) < distance)) return false;
  }
  return true;
}

constexpr Step coarse_step{1e-3, 1e-3};

numerics::LevenbergMarquardtOptions coarse_options() {
  numerics::LevenbergMarquardtOptions out;
  out.max_iterations = 25;
  out.parameter_tolerance = 5e-4;
  out.function_tolerance = 1e-7;
  return out;
}

/// The best place on a line through one offset, the others kept.
Candidate best_on_line(const Problem& coarse, std::vector<double> p, std::size_t i) {
  Candidate best{p, std::numeric_limits<double>::infinity()};
  const double here = p[i];
  for (int k = -4; k <= 4; ++k) {
    if (k == 0) continue;
    p[i] = here + 0.3 * k;
    const double rss = rss_at(coarse, p);
    if (rss < best.rss) best = {p, rss};
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
  for (int round = 0; better && round < 3 && !coarse.stop.over(); ++round) {
    better = false;
    for (std::size_t i = 0; i < count; ++i) {
      Candidate moved = best_on_line(coarse, best.p, i);
      if (!(moved.rss < hopeless * best.rss)) continue;
      Minimum m = refine(coarse, std::move(moved.p), coarse_step, coarse_options());
      if (!(m.rss < 0.999 * best.rss)) continue;
      best = std::move(m);
      better = true;
    }
  }
}

/// The first so many candidates that are not the same one with other numbers of teeth.
std::vector<std::vector<double>> first_starts(const Problem& problem,
                                              const std::vector<Candidate>& candidates,
                                              std::size_t count) {
  std::vector<std::vector<double>> out;
  for (const Candidate& candidate : candidates) {
    if (out.size() == count) break;
    std::vector<double> p = candidate.p;
    apply_gauge(problem, p);
    const auto same = [&](const auto& other) { return nearly_equal(p, other, 0.03); };
    if (std::ranges::none_of(out, same)) out.push_back(std::move(p));
  }
  return out;
}

/// Leave a local minimum in which the teeth of one run are numbered otherwise than those
/// of another, or a phase is off by a pitch: with the runout found, all phases again.
void renumber(const Problem& coarse, Minimum& m) {
  const auto n = static_cast<std::ptrdiff_t>(coarse.unknowns.runout_count());
  if (n == 0 || coarse.unknowns.phases < 2) return;
  for (int round = 0; round < 3 && !coarse.stop.exhausted(); ++round) {
    const std::vector<double> runout(m.p.begin(), m.p.begin() + n);
    const std::vector<Candidate> found = scan(coarse, {runout});
    if (found.empty()) return;
    std::vector<double> p = m.p;
    const auto phases = static_cast<std::ptrdiff_t>(coarse.unknowns.first_phase());
    std::copy(found.front().p.begin() + phases, found.front().p.end(),
              p.begin() + phases);
    if (!(rss_at(coarse, p) < 0.9 * m.rss)) return;
    Minimum better = refine(coarse, std::move(p), coarse_step, coarse_options());
    if (!(better.rss < 0.99 * m.rss)) return;
    m = std::move(better);
  }
}

/// Local minima from the best candidates, the best first.
std::vector<Minimum> coarse_minima(const Problem& coarse,
                                   const std::vector<Candidate>& candidates,
                                   std::size_t starts) {
  std::vector<std::vector<double>> from = first_starts(coarse, candidates, starts);
  std::vector<std::optional<Minimum>> found(from.size());
  const auto follow = [&](std::size_t i) {
    if (i > 0 && coarse.stop.over()) return;
    Minimum& m = found[i].emplace(
        refine(coarse, std::move(from[i]), coarse_step, coarse_options()));
    renumber(coarse, m);
    apply_gauge(coarse, m.p);
  };
  numerics::for_each_index(from.size(), follow, 1);
  std::vector<Minimum> out;
  for (std::optional<Minimum>& one : found) {
    if (!one) continue;
    Minimum& m = *one;
    const bool known = std::ranges::any_of(out, [&](const Minimum& other) {
      return nearly_equal(m.p, other.p, same_minimum);
    });
    if (!known) out.push_back(std::move(m));
  }
  std::ranges::stable_sort(out, {}, &Minimum::rss);
  return out;
}

/// With the names of the gauge, and still the minimum.
Minimum named(const Problem& problem, Minimum best) {
  const bool jumps = sum_of_squares_jumps(problem);
  // Renumbering changes the common part of the offsets, which has a slight effect.
  if (apply_gauge(problem, best.p) && !jumps) best = settle(problem, best.p);
  return best;
}

/// The place that setup and options name, if they name any.
std::optional<Candidate> given_start(const Problem& problem) {
  if (problem.start) return Candidate{parameters_of(problem, *problem.start), 0.0};
  const std::vector<double> runout = given_runout(problem);
  if (std::ranges::all_of(runout, [](double v) { return v == 0.0; })) {
    return std::nullopt;
  }
  const std::vector<Candidate> found = scan(problem, {runout});
  return found.empty() ? std::nullopt : std::optional(found.front());
}

/// Whether neighbouring residuals are no more alike than those of white noise: what then
/// is left to explain is hardly more than chance. Rows of a band do not tell.
bool leaves_noise(const Problem& problem, const Minimum& m) {
  const auto banded = [](const FoldedRun& run) { return run.band > 0; };
  return std::ranges::none_of(problem.runs, banded) &&
         m.correlation <= white / std::sqrt(static_cast<double>(problem.rows()));
}

/// The same from as many as make the best of them the global one. With many teeth that may
/// be more than usual: as long as much is left that is not noise, the search goes on.
std::vector<Minimum> coarse_minima(const Problem& coarse,
                                   const std::vector<Candidate>& candidates) {
  constexpr int many_offsets = 5;
  constexpr std::size_t more_starts = 18;
  constexpr double much_left = 0.05;  // of how the force changes, rms
  const int offsets = coarse.unknowns.runout_count();
  std::vector<Minimum> out = coarse_minima(coarse, candidates, offsets > 2 ? 6U : 3U);
  const auto is_good = [&](const Minimum& m) {
    return m.rss < much_left * much_left * rss_of_means(coarse) ||
           leaves_noise(coarse, m);
  };
  if (offsets >= many_offsets && !is_good(out.front()) && !coarse.stop.over()) {
    out = coarse_minima(coarse, candidates, more_starts);
  }
  move_single_teeth(coarse, out.front());
  return out;
}

/// Whether a minimum leaves little of how the force changes, or nothing but noise.
bool explains(const Problem& problem, const Minimum& m) {
  return m.rss < little_left * little_left * rss_of_means(problem) ||
         leaves_noise(problem, m);
}

/// The minimum near a given start, if the start is worth its name.
std::optional<Minimum> from_given(const Problem& problem) {
  const std::optional<Candidate> given = given_start(problem);
  if (!given || !in_range(problem, given->p)) return std::nullopt;
  const bool jumps = sum_of_squares_jumps(problem);
  Minimum m{given->p, 0.0, true, ""};
  if (!problem.start_of_fit) {
    const Problem coarse = jumps ? smooth_problem(problem) : coarse_problem(problem);
    m = refine(coarse, given->p, coarse_step, coarse_options());
    move_single_teeth(coarse, m);
  }
  m = jumps ? refine_between_jumps(problem, m.p) : settle(problem, m.p);
  const auto n = static_cast<std::size_t>(problem.unknowns.runout_count());
  const std::vector<double> from(given->p.begin(),
                                 given->p.begin() + static_cast<std::ptrdiff_t>(n));
  const bool worth =
      m.converged && nearly_equal(from, m.p, near_start) && explains(problem, m);
  return worth ? std::optional(named(problem, std::move(m))) : std::nullopt;
}

Minimum search_between_jumps(const Problem& problem,
                             const std::vector<Candidate>& candidates) {
  const Problem smooth = smooth_problem(problem);
  const std::vector<Minimum> minima = coarse_minima(smooth, candidates);
  Minimum best = refine_between_jumps(problem, minima.front().p);
  if (minima.size() > 1 && minima[1].rss < near_tie * minima[0].rss &&
      !problem.stop.over()) {
    Minimum second = refine_between_jumps(problem, minima[1].p);
    if (second.rss < best.rss) best = std::move(second);
  }
  return best;
}

}  // namespace

Problem coarse_problem(const Problem& problem) {
  Problem out = problem;
  for (FoldedRun& run : out.runs) run = coarsen(run, coarse_bins);
  out.tolerance = std::max(problem.tolerance, 1e-6);
  out.angles = coarse_angles;
  return out;
}

Minimum settle(const Problem& problem, const std::vector<double>& start) {
  if (sum_of_squares_jumps(problem)) return refine_between_jumps(problem, start);
  numerics::LevenbergMarquardtOptions options;
  options.max_iterations = 40;
  options.parameter_tolerance = 1e-7;
  options.function_tolerance = 1e-24;
  options.standard_errors = last_step;
  Minimum out = refine(problem, start, {}, options);
  // Kinks of the sum of squares can keep the steps from vanishing, at a tooth that just stops
  // cutting above all; what counts is that they no longer gain anything.
  constexpr int rounds = 12;
  for (int i = 0; i < rounds && !out.converged && !problem.stop.exhausted(); ++i) {
    Minimum again = refine(problem, out.p, {}, options);
    again.converged = again.converged || again.rss > out.rss * (1.0 - 1e-6);
    out = std::move(again);
  }
  return out;
}

Minimum coarse_search(const Problem& problem,
                      const std::vector<Candidate>& candidates) {
  if (candidates.empty()) return {{}, 0.0, false, no_start};
  if (problem.unknowns.count() == 0) return refine(problem, {}, {}, {});
  return coarse_minima(coarse_problem(problem), candidates, starts_to_rank).front();
}

Minimum search_from(const Problem& problem, const std::vector<Candidate>& candidates) {
  if (candidates.empty()) return {{}, 0.0, false, no_start};
  if (problem.unknowns.count() == 0) return refine(problem, {}, {}, {});
  if (sum_of_squares_jumps(problem)) {
    return named(problem, search_between_jumps(problem, candidates));
  }
  const std::vector<Minimum> minima =
      coarse_minima(coarse_problem(problem), candidates);
  Minimum best = settle(problem, minima.front().p);
  if (minima.size() > 1 && minima[1].rss < near_tie * minima[0].rss &&
      !problem.stop.over()) {
    Minimum second = settle(problem, minima[1].p);
    if (second.rss < best.rss) best = std::move(second);
  }
  return named(problem, std::move(best));
}

Minimum search(const Problem& problem) {
  if (problem.unknowns.count() == 0) return refine(problem, {}, {}, {});
  if (std::optional<Minimum> given = from_given(problem)) return *std::move(given);
  return search_from(problem, scan(problem, runout_starts(problem)));
}

void restrict_eccentricity(Problem& problem, std::vector<double>& p) {
  if (problem.unknowns.runout != RunoutUnknowns::eccentricity) return;
  const Point point = point_of(problem, p);
  const Problem coarse = coarse_problem(problem);
  const Evaluation at = evaluate(coarse, p);
  const numerics::Columns D = design(coarse, at);
  const std::vector<double> force = measured(coarse);
  std::vector<double> residual = force;
  const std::vector<double> K = numerics::project_out(D, gram_of(D), residual);
  problem.unknowns.direction =
      single_direction(coarse, p, K, numerics::norm(residual) / numerics::norm(force));
  if (!problem.unknowns.direction) return;
  p = settle(problem, parameters_of(problem, point)).p;
}

}  // namespace trochoid::identification
