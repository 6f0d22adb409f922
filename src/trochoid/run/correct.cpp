#include <trochoid/run/correct.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/run/commands.h>
#include <trochoid/run/problems.h>
#include <trochoid/run/records.h>

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace trochoid::run {

namespace {

using Warnings = std::vector<base::Warning>;

correction::MovingCut moving_cut(const cases::Case& given) {
  correction::MovingCut cut{.setup = given.setup, .law = given.law};
  for (const dynamics::ChipMode& mode : chip_modes(given.machine.modes).modes) {
    if (!mode.of_table) {
      cut.tool.push_back(mode);
    }
  }
  cut.plant = plant_of(given.machine);
  cut.slices = correction::slices_for(given.setup);
  cut.revolutions = static_cast<int>(given.sampling.revolutions);
  cut.samples_per_rev = given.sampling.samples_per_rev;
  return cut;
}

correction::ForceRecord record_of(const cases::Case& given,
                                  std::vector<base::Warning>& warnings) {
  const auto runs = measured_runs(given, warnings);
  for (const MeasuredRun& one : runs) {
    if (std::ranges::all_of(one.run.measured, std::identity())) continue;
    throw base::InputError(
        {one.file + ": not all three channels were measured; must have three forces"});
  }
  const auto M = given.dynamometer.value_or(cases::Dynamometer{}).matrix;
  identification::Run run = identification::on_tool(channels_of(runs), M).front();
  return {std::move(run.angle), std::move(run.force)};
}

/// Fraction of the variance that a model must explain to be believed.
constexpr double well_explained = 0.9;
/// A chip area that differs so much where the peaks do not is worth a word.
constexpr double unequal_area = 0.1;
/// Fraction of the chip differences that one axis should be able to take away.
constexpr double one_axis_enough = 0.8;

void warn_limits(const correction::LimitReport& report, Warnings& warnings) {
  for (const correction::Limit& l : report.limits) {
    if (l.known && !l.ok) {
      warnings.push_back({"beyond_limit", l.reason});
    }
  }
}

void warn_flutes(const correction::BeforeAfter& cuts, Warnings& warnings) {
  const dynamics::Motion& before = cuts.before.motion;
  const dynamics::Motion& after = cuts.after.motion;
  if (!dynamics::repeats_every_turn(before) || !dynamics::repeats_every_turn(after)) {
    warnings.push_back(
        {"not_periodic",
         fmt::format("The force still changes by {:.3g} N from turn to turn: a "
                     "difference between flutes means little then.",
                     std::max(before.last_change, after.last_change))});
  }
  const double own = correction::own_difference(cuts.after);
  if (own > unequal_area && dynamics::peak_difference(after) < own / 2) {
    warnings.push_back(
        {"unequal_forces",
         fmt::format("Several teeth cut at once: the peaks of the whole force, which a "
                     "dynamometer shows, are made equal. The peaks of the flutes' "
                     "own forces still differ by {:.0f} % ({:.0f} % before).",
                     100 * own, 100 * correction::own_difference(cuts.before))});
  }
  if (dynamics::area_difference(after) > unequal_area) {
    warnings.push_back(
        {"unequal_chips",
         fmt::format("Equal peaks are not equal chips: the flutes still cut areas that "
                     "differ by {:.0f} % ({:.0f} % before).",
                     100 * dynamics::area_difference(after),
                     100 * dynamics::area_difference(before))});
  }
}

void warn_axes(const correction::AxisLimits& axes, Warnings& warnings) {
  if (axes.most_teeth > 1 && axes.one_axis > (1 - one_axis_enough) * axes.uncorrected) {
    warnings.push_back(
        {"several_teeth_in_cut",
         fmt::format(
             "{} teeth cut at once: one axis can take the chip differences from {:.3g} "
             "to {:.3g} um at best, two axes to {:.3g} um (root mean square).",
             axes.most_teeth, axes.uncorrected / unit::um, axes.one_axis / unit::um,
             axes.two_axes / unit::um)});
  }
}

void warn_estimate(const correction::Setting& s, Warnings& warnings) {
  if (s.fit && s.designed_for != s.rho) {
    warnings.push_back(
        {"static_estimate",
         fmt::format(
             "The command is made for what a rigid model reads from the forces: "
             "{:.3g} um between tooth 1 and the one before. The true difference "
             "is {:.3g} um, as tool and table deflect.",
             correction::chip_differences(s.designed_for)[0] / unit::um,
             correction::chip_differences(s.rho)[0] / unit::um)});
  }
}

std::string headline(const correction::BeforeAfter& cuts) {
  return fmt::format(
      "The flutes' peaks differ by {:.2f} % with the command, {:.2f} % without.",
      100 * dynamics::peak_difference(cuts.after.motion),
      100 * dynamics::peak_difference(cuts.before.motion));
}

/// A speed read from so coarse an encoder jumps by as much from step to step.
constexpr double coarse = 0.5;

/// Why a controller that waits never began.
std::string never_running(const correction::ControllerInLoop& run) {
  std::string text = "The controller never runs in the turns simulated";
  if (run.held_by == TROCHOID_NO_PROBLEM) {
    return text + ": they end before it has seen enough of them in order.";
  }
  text += fmt::format(": in {:.0f} % of the steps in which it waits, {}.",
                      100 * run.held_part, trochoid_problem_name(run.held_by));
  if (run.coarse_speed > coarse) {
    text += fmt::format(
        " A count of the encoder in one step of the loop is {:.0f} % of the speed: with "
        "so few counts (encoder_counts), or so fast a loop, the speed that it reads jumps.",
        100 * run.coarse_speed);
  }
  return text;
}

/// What the controller made of the cut, by its last turn.
std::string controller_words(const correction::ControllerInLoop& run) {
  const correction::LoopTurn* running = correction::last_running(run);
  if (running == nullptr && run.fault == TROCHOID_NO_PROBLEM) {
    return never_running(run);
  }
  if (run.fault != TROCHOID_NO_PROBLEM) {
    return fmt::format("The controller stops at {:.3f} s: {}.", run.fault_time,
                       trochoid_problem_name(run.fault));
  }
  return fmt::format("Under the controller they differ by {:.2f} %.",
                     100 * running->difference);
}

/// The limit that the command comes nearest to; empty: none is known.
std::string nearest_limit(const correction::LimitReport& report) {
  const correction::Limit* nearest = nullptr;
  const auto share = [](const correction::Limit& l) { return l.value / l.limit; };
  for (const correction::Limit& limit : report.limits) {
    const bool counts = limit.known && limit.limit > 0;
    if (counts && (nearest == nullptr || share(limit) > share(*nearest))) {
      nearest = &limit;
    }
  }
  if (nearest == nullptr) return {};
  return fmt::format(" {}: {}.",
                     report.ok ? "Nearest to its limit" : "Beyond its limit",
                     nearest->reason);
}

}  // namespace

correction::CorrectionProblem correction_problem(const cases::Case& given,
                                                 bool controller,
                                                 std::vector<base::Warning>& warnings) {
  correction::CorrectionProblem problem{.cut = moving_cut(given),
                                        .limits = limits_of(*given.machine.actuator),
                                        .options = given.machine.correct->options};
  problem.options.spindle_speeds = base::values(*given.machine.correct->spindle_speed);
  problem.options.spindle = given.machine.spindle;
  if (!given.measurements.empty()) {
    problem.cut.setup.cut = given.measurements.front().cut;
    problem.record = record_of(given, warnings);
  }
  if (controller) {
    problem.controller = given.machine.controller.value_or(correction::LoopOptions{});
  }
  return problem;
}

void add_setting_warnings(const correction::Setting& setting, Warnings& warnings) {
  if (!setting.behind) {
    return;
  }
  if (setting.fit->explained < well_explained) {
    warnings.push_back(
        {"poor_fit",
         fmt::format("The model explains {:.0f} % of the measured forces: look at "
                     "identify before using this command.",
                     100 * setting.fit->explained)});
  }
  if (!setting.behind->ok) {
    warnings.push_back(
        {"compliance_not_removed",
         "The deflection of tool and table was not taken out of the estimate: " +
             setting.behind->reason});
  }
}

void add_correction_warnings(const correction::Correction& c, Warnings& warnings) {
  warn_limits(c.plan.limits, warnings);
  warn_flutes(c.cuts, warnings);
  warn_axes(c.axes, warnings);
  warn_estimate(c.setting, warnings);
  if (c.controller && !c.controller->turns.empty() &&
      correction::last_running(*c.controller) == nullptr) {
    warnings.push_back({"never_running", never_running(*c.controller)});
  }
  if (c.controller && !c.controller->finite) {
    warnings.push_back(
        {"ran_away", "Under the controller the cut grew beyond all bounds."});
  }
}

results::CorrectResult correct(const cases::Case& given, bool controller,
                               const Progress& progress) {
  results::CorrectResult r{.heading = heading_of(given)};
  r.heading.ok = false;
  const auto problem = correction_problem(given, controller, r.heading.warnings);
  r.options = problem.options;
  const int steps = dynamics::steps_needed(correction::problem_of(problem.cut, {}));
  if (steps > dynamics::most_steps) {
    r.heading.message = too_many_steps(steps);
    return r;
  }
  r.correction = correction::correct(problem, progress);
  const correction::Correction& c = r.correction;
  add_setting_warnings(c.setting, r.heading.warnings);
  if (!c.ok) {
    r.heading.message = c.reason;
    return r;
  }
  add_correction_warnings(c, r.heading.warnings);
  r.heading.ok = !c.controller || c.controller->ok;
  r.heading.message = r.heading.ok ? headline(c.cuts) + nearest_limit(c.plan.limits)
                                   : c.controller->reason;
  if (r.heading.ok && c.controller) {
    const bool runs = correction::last_running(*c.controller) != nullptr;
    // What a command alone would do is no answer where none is given.
    r.heading.message = runs ? r.heading.message + ' ' + controller_words(*c.controller)
                             : controller_words(*c.controller);
  }
  return r;
}

}  // namespace trochoid::run
