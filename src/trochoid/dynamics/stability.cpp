#include <trochoid/dynamics/stability.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/period_elements.h>
#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cmath>

namespace trochoid::dynamics {

namespace {

/// Of the directional matrices: far below any tolerance of a multiplier.
constexpr double matrix_tolerance = 1e-10;
/// Of the multipliers of the diagram and of its limit depths.
constexpr double map_tolerance = 1e-5;
/// Chatter frequencies with less than this fraction of the strongest are not listed.
constexpr double least_line = 0.1;
/// Of which only the strongest is wanted.
constexpr double strongest_line = 0.9;
/// How many depths up to the greatest are looked at for the limit of the case.
constexpr int depths_looked_at = 100;
/// In a period of the cut: with more, the linearised cut takes too long.
constexpr double most_vibrations = 400;

DirectionalModel directional_model(const StabilityProblem& problem, double floor) {
  return {problem.setup, problem.law, floor, matrix_tolerance,
          reach_of(problem, fastest_frequency(problem.system))};
}

/// The cut ready to be asked.
struct LimitOfSpeed {
  const StabilityProblem& problem;
  double Omega = problem.setup.cut.Omega;
  double a_p = problem.setup.cut.a_p;
  DirectionalModel model = directional_model(problem, problem.options.chip_floor);
  Directional directional = model.at_depth(a_p);
};

StabilityVerdict verdict_of(double growth, double margin) {
  if (std::abs(growth - 1) <= margin) {
    return StabilityVerdict::marginal;
  }
  return growth < 1 ? StabilityVerdict::stable : StabilityVerdict::unstable;
}

bool cuts(const Directional& directional) {
  return std::any_of(directional.elements.begin(), directional.elements.end(),
                     [](const DirectionalElement& e) {
                       return std::any_of(e.matrices.begin(), e.matrices.end(),
                                          [](const auto& m) { return !m.empty(); });
                     });
}

/// |mu| with another floor of the chip.
double with_floor(const LimitOfSpeed& point, double floor) {
  const StabilityProblem& p = point.problem;
  return std::abs(multiplier(directional_model(p, floor).at_depth(point.a_p), p.system,
                             point.Omega, p.options.tolerance)
                      .value);
}

/// Does the verdict hang on the floor of a power law?
std::optional<ChipFloorCheck> floor_check(const LimitOfSpeed& point,
                                          StabilityVerdict verdict) {
  if (!force::form(point.problem.law).power) {
    return std::nullopt;
  }
  const StabilityOptions& options = point.problem.options;
  ChipFloorCheck check{.at_half = with_floor(point, 0.5 * options.chip_floor),
                       .at_twice = with_floor(point, 2 * options.chip_floor)};
  check.decided = verdict == verdict_of(check.at_half, options.margin) &&
                  verdict == verdict_of(check.at_twice, options.margin);
  return check;
}

std::vector<double> depths_up_to(double greatest) {
  std::vector<double> depths;
  for (int i = 1; i <= depths_looked_at; ++i) {
    depths.push_back(greatest * i / depths_looked_at);
  }
  return depths;
}

std::optional<DepthLimit> depth_limit(const LimitOfSpeed& point, double factor,
                                      double greatest) {
  const std::vector<double> looked_at = depths_up_to(greatest);
  const StabilityProblem& p = point.problem;
  const auto limit =
      limit_depth(point.model, p.system, point.Omega, looked_at, p.options.tolerance);
  if (!limit) {
    return std::nullopt;
  }
  return DepthLimit{*limit, chatter_lines(point.model.at_depth(limit->depth), p.system,
                                          point.Omega, factor, least_line)};
}

/// The limit of the same cut with sharp edges.
std::optional<Limit> sharp_limit(const StabilityProblem& problem, double greatest) {
  StabilityProblem sharp = problem;
  sharp.setup.process_damping = {};
  return limit_depth(directional_model(sharp, problem.options.chip_floor),
                     problem.system, problem.setup.cut.Omega, depths_up_to(greatest),
                     problem.options.tolerance);
}

std::vector<LimitPoint> with_frequencies(const LimitOfSpeed& point,
                                         const std::vector<Limit>& limits) {
  std::vector<LimitPoint> curve(limits.size());
  numerics::for_each_index(limits.size(), [&](std::size_t i) {
    const auto lines =
        chatter_lines(point.model.at_depth(limits[i].depth), point.problem.system,
                      limits[i].Omega, limits[i].factor, strongest_line);
    curve[i] = {limits[i], lines.empty() ? 0.0 : lines.front().frequency};
  });
  return curve;
}

void add_lobes(const LimitOfSpeed& point, const StabilityProgress& progress,
               Stability& out) {
  const StabilityProblem& p = point.problem;
  const auto watch = [&](const char* what) {
    const auto tell = [&progress, what](double share) { progress(what, share); };
    return LobeWatch{progress ? LobeProgress(tell) : LobeProgress(), p.stop};
  };
  out.lobes = lobe_grid(point.model, p.system, p.spindle_speeds, p.depths,
                        LobeAccuracy{.near = map_tolerance}, watch("lobes"));
  const auto limits =
      limit_curve(point.model, p.system, out.lobes, map_tolerance, watch("limit"));
  out.whole = !p.stop.wanted();
  if (out.whole) {  // a curve with gaps would say that there is no limit in them
    out.limit_curve = with_frequencies(point, limits);
  }
}

}  // namespace

Reach reach_of(const StabilityProblem& problem, double fastest) {
  const geometry::Cut& cut = problem.setup.cut;
  Reach reach{cut.a_p, cut.Omega};
  for (const double depth : problem.depths) {
    reach.deepest = std::max(reach.deepest, depth);
  }
  for (const double Omega : problem.spindle_speeds) {
    reach.cycle = std::min(reach.cycle, Omega);
  }
  reach.cycle /= fastest;
  return reach;
}

Stability stability(const StabilityProblem& problem,
                    const StabilityProgress& progress) {
  const LimitOfSpeed point{problem};
  const StabilityOptions& options = problem.options;
  Stability out{.multiplier = multiplier(point.directional, problem.system, point.Omega,
                                         options.tolerance),
                .period = point.directional.period,
                .cuts = cuts(point.directional)};
  const Multiplier& mu = out.multiplier;
  out.verdict = verdict_of(std::abs(mu.value), options.margin);
  out.lines = chatter_lines(point.directional, problem.system, point.Omega, mu.factor,
                            least_line);
  out.floor = floor_check(point, out.verdict);
  if (out.floor && !out.floor->decided) {
    out.verdict = StabilityVerdict::marginal;
  }
  out.greatest_depth =
      problem.depths.empty() ? point.a_p : std::max(problem.depths.back(), point.a_p);
  out.limit = depth_limit(point, mu.factor, out.greatest_depth);
  if (problem.setup.process_damping.acts()) {
    out.sharp_limit = sharp_limit(problem, out.greatest_depth);
  }
  if (!problem.spindle_speeds.empty() && !problem.depths.empty()) {
    add_lobes(point, progress, out);
  }
  return out;
}

std::optional<double> linear_growth(const force::Setup& setup, const force::Law& law,
                                    const System& system,
                                    const StabilityOptions& options) {
  const double Omega = setup.cut.Omega;
  double fastest = 0.0;
  for (const ChipMode& mode : system.modes) {
    fastest = std::max(fastest, std::sqrt(mode.stiffness / mode.mass));
  }
  const DirectionalModel model(setup, law, options.chip_floor, matrix_tolerance,
                               {setup.cut.a_p, Omega * unit::turn / fastest});
  const Directional directional = model.at_depth(setup.cut.a_p);
  if (fastest * directional.period / (unit::turn * Omega) > most_vibrations) {
    return std::nullopt;
  }
  const Multiplier mu = multiplier(directional, system, Omega, options.tolerance);
  return std::pow(std::abs(mu.value), unit::turn / directional.period);
}

}  // namespace trochoid::dynamics
