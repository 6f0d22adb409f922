#include <trochoid/identification/local_minimum.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/numerics/columns.h>
#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/secant_levenberg_marquardt.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

namespace trochoid::identification {
namespace {

double squared(std::span<const double> v) {
  return numerics::dot(v, v);
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

namespace {

using base::index;

/// Harmonics that a smooth problem keeps at most, and one of so many samples.
constexpr int most_smooth_harmonics = 16;
constexpr int samples_a_harmonic = 6;
/// It has no more angles than this, which is plenty for its harmonics.
constexpr int most_smooth_angles = 240;
/// Equal steps of the turn in which jumps are looked for.
constexpr int steps_of_turn = 256;
/// Phases are compared within so many samples of the present one, at so many places.
constexpr double reach = 1.5;
constexpr std::size_t most_places = 24;
/// From so many of them the sum of squares is followed downhill.
constexpr std::size_t followed = 2;

double spacing(const FoldedRun& run) {
  return unit::turn / static_cast<double>(run.angle.size());
}

bool jumps(const Problem& problem, const FoldedRun& run) {
  return run.turn_map.empty() && enters_suddenly(problem, run, spacing(run));
}

/// A minimum on the way, and the evaluation there.
struct Place {
  const Problem& problem;
  Minimum at;
  Evaluation last;

  /// @return whether p is better
  bool try_at(std::vector<double> p) {
    const double rss = rss_at(problem, p, last);
    if (!(rss < at.rss)) return false;
    at.rss = rss;
    at.p = std::move(p);
    return true;
  }
};

/// One round of a pattern search: every unknown up and down by its step.
bool explore(std::span<const double> steps, Place& place) {
  bool better = false;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (const double sign : {1.0, -1.0}) {
      std::vector<double> p = place.at.p;
      p[i] += sign * steps[i];
      if (!place.try_at(std::move(p))) continue;
      better = true;
      break;
    }
  }
  return better;
}

/// Over the edges of the smooth pieces, which the smooth steps do not cross.
void pattern_search(std::vector<double> steps, Place& place) {
  for (int round = 0; round < 40; ++round) {
    const std::vector<double> before = place.at.p;
    if (explore(steps, place)) {
      std::vector<double> ahead = place.at.p;
      for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] += ahead[i] - before[i];
      place.try_at(std::move(ahead));
      continue;
    }
    for (double& s : steps) s *= 0.3;
    if (*std::ranges::max_element(steps) < 1e-5) return;
  }
}

/// Smooth steps; those that a jump makes worse are taken back.
void improve(Place& place) {
  numerics::LevenbergMarquardtOptions options;
  options.max_iterations = 15;
  options.parameter_tolerance = 1e-8;
  options.function_tolerance = 1e-16;
  Minimum smooth = refine(place.problem, place.at.p, {1e-5, 1e-6}, options);
  if (smooth.rss < place.at.rss) {
    place.at.p = std::move(smooth.p);
    place.at.rss = smooth.rss;
  }
}

/// Phases of a run, one in each smooth piece of the sum of squares near the present one.
std::vector<double> phases_between_jumps(const FoldedRun& run,
                                         const force::ForceMatrix& matrix,
                                         double phase) {
  const double width = reach * spacing(run);
  std::vector<double> edges = {phase - width, phase + width};
  for (const double jump : jump_angles(matrix, steps_of_turn)) {
    for (const double angle : run.angle) {
      const double off = jump - angle - phase;
      const double from_phase = off - unit::turn * std::round(off / unit::turn);
      if (std::abs(from_phase) < width) edges.push_back(phase + from_phase);
    }
  }
  std::ranges::sort(edges);
  const std::size_t stride = 1 + edges.size() / most_places;
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < edges.size(); i += stride) {
    if (edges[i + 1] - edges[i] > 1e-9) out.push_back(0.5 * (edges[i] + edges[i + 1]));
  }
  return out;
}

/// The best smooth pieces of one phase, followed downhill.
void improve_around(std::size_t run, Place& place) {
  const Problem& problem = place.problem;
  const std::size_t i = index(problem.unknowns.first_phase()) + run;
  Evaluation here = place.last;
  evaluate(problem, place.at.p, here);
  std::vector<Minimum> found;
  for (const double phase :
       phases_between_jumps(problem.runs[run], here.matrix[run], place.at.p[i])) {
    std::vector<double> p = place.at.p;
    p[i] = phase;
    const double rss = rss_at(problem, p, place.last);
    found.push_back({std::move(p), rss, true, place.at.reason});
  }
  std::ranges::stable_sort(found, {}, &Minimum::rss);
  if (found.size() > followed) found.resize(followed);
  for (Minimum& m : found) {
    Place other{problem, std::move(m), here};
    improve(other);
    if (other.at.rss < place.at.rss) place.at = std::move(other.at);
  }
}

}  // namespace

bool sum_of_squares_jumps(const Problem& problem) {
  if (problem.unknowns.phases == 0) return false;
  return std::ranges::any_of(problem.runs,
                             [&](const FoldedRun& run) { return jumps(problem, run); });
}

Problem smooth_problem(const Problem& problem) {
  Problem out = problem;
  out.tolerance = std::max(problem.tolerance, 1e-6);
  for (FoldedRun& run : out.runs) {
    const int samples = static_cast<int>(run.angle.size());
    run = from_turn(coarsen(run, most_smooth_angles),
                    std::clamp(samples / samples_a_harmonic, 1, most_smooth_harmonics));
  }
  return out;
}

Minimum refine_between_jumps(const Problem& problem, std::vector<double> start) {
  Place place{problem, {std::move(start), 0.0, true, "nothing better is near"}, {}};
  place.at.rss = rss_at(problem, place.at.p, place.last);
  for (int round = 0; round < 4; ++round) {
    const double before = place.at.rss;
    std::vector<double> steps(place.at.p.size(), 0.01);
    for (int r = 0; r < problem.unknowns.phases; ++r) {
      const FoldedRun& run = problem.runs[index(r)];
      if (!jumps(problem, run)) continue;
      improve_around(index(r), place);
      steps[index(problem.unknowns.first_phase() + r)] = 0.3 * spacing(run);
    }
    pattern_search(steps, place);
    improve(place);
    if (!(place.at.rss < before * (1.0 - 1e-9))) break;
  }
  return place.at;
}

}  // namespace trochoid::identification
