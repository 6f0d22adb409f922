#include <trochoid/run/commands.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/stability.h>
#include <trochoid/run/problems.h>
#include <trochoid/run/vibration.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trochoid::run {

namespace {

using dynamics::MotionProblem;
using dynamics::SteadyState;
using results::MotionResult;

MotionResult failed(MotionResult r, std::string why) {
  r.heading.ok = false;
  r.heading.message = std::move(why);
  return r;
}

MotionResult result_of(const cases::Case& given, const MotionProblem& problem) {
  const double D = problem.setup.cutter.profile.D;
  MotionResult r{.heading = heading_of(given),
                 .system = problem.system,
                 .damping = problem.setup.process_damping,
                 .steps_per_tooth = problem.grid.steps_per_tooth,
                 .engagement = chip::tooth_arc(problem.setup.cut.engagement, D, D / 2),
                 .entry = geometry::tooth_angles(problem.setup.cutter)};
  for (double& angle : r.entry) {
    angle += r.engagement.from;
  }
  return r;
}

/// The motion until it repeats, with what share of the turns asked for is done.
SteadyState followed(MotionProblem problem, const Progress& progress) {
  if (!progress) {
    return dynamics::steady_state(problem);
  }
  int asked = problem.revolutions;
  const auto tell = [&](int done) {
    progress(
        {fmt::format("Cutting, {} turns", asked), static_cast<double>(done) / asked});
  };
  problem.turned = tell;
  return dynamics::steady_state(problem, [&](int turns) {
    asked = turns;
    tell(0);
  });
}

/// Below it an error of a wall is none [m].
constexpr double least_error = 0.05 * unit::um;

/// What the motion does to the forces and the walls.
std::string effect_of(const MotionResult& r) {
  const dynamics::Motion& motion = r.steady->motion;
  std::string text =
      fmt::format(" The force in the plane of the table reaches {:.3g} N", motion.peak);
  if (motion.flutes.size() > 1) {
    text += fmt::format("; the flutes' peaks of Fy differ by {:.2f} %",
                        100 * dynamics::peak_difference(motion));
  }
  const auto farthest = std::ranges::max_element(
      r.walls, {}, [](const auto& wall) { return std::abs(wall.remains); });
  if (farthest != r.walls.end()) {
    const double off = std::abs(farthest->remains);
    text +=
        off < least_error
            ? fmt::format("; the wall is off by less than {:g} um",
                          least_error / unit::um)
            : fmt::format("; the wall is off by up to {:.3g} um (material {})",
                          off / unit::um, farthest->remains < 0 ? "missing" : "left");
  }
  return text + '.';
}

}  // namespace

MotionResult dynamics(const cases::Case& given, const Progress& progress) {
  const MotionProblem problem = motion_problem(given);
  MotionResult r = result_of(given, problem);
  if (problem.grid.steps_per_tooth > dynamics::most_steps) {
    return failed(std::move(r), too_many_steps(problem.grid.steps_per_tooth));
  }
  SteadyState steady = followed(problem, progress);
  if (steady.motion.finite && !steady.motion.solved) {
    return failed(std::move(r),
                  "no force was found that agrees with the motion it makes: a mode is "
                  "too soft, or too light, for this cut");
  }
  r.linear_growth = dynamics::linear_growth(problem.setup, problem.law, problem.system,
                                            stability_options(given));
  r.steady = std::move(steady);
  if (std::holds_alternative<dynamics::Growing>(r.steady->verdict)) {
    std::string why = growth_message(*r.steady, r.linear_growth);
    return failed(std::move(r), std::move(why));
  }
  base::add(r.heading.warnings, motion_warnings(given, *r.steady, r.linear_growth));
  if (dynamics::walls_repeat(*r.steady)) {
    r.walls = dynamics::surface_location(problem, r.steady->motion,
                                         dynamics::wall_heights(problem.setup));
  }
  r.heading.message = motion_message(*r.steady) + effect_of(r);
  return r;
}

}  // namespace trochoid::run
