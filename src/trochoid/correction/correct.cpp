#include <trochoid/correction/correct.h>

#include <trochoid/correction/estimator_model.h>

namespace trochoid::correction {

Correction correct(const CorrectionProblem& problem,
                   const CorrectionProgress& progress) {
  const auto tell = [&](const char* what) {
    if (progress) {
      progress(what);
    }
  };
  const CorrectionOptions& options = problem.options;
  Correction c;
  tell("Looking for the runout");
  c.setting = problem.record
                  ? measured_setting(problem.cut, problem.limits, *problem.record,
                                     options.estimate)
                  : known_setting(problem.cut, problem.limits, options.estimate);
  if (!c.setting.ok) {
    c.reason = c.setting.reason;
    return c;
  }
  if (!nothing_to_correct(c.setting, options)) {
    // Before a command is looked for: chatter has no peaks that one could make equal.
    tell("Cutting without a command");
    c.cuts.before = moved_cut(c.setting, Harmonics{});
    c.reason = chatter_in(c.cuts.before, "before");
    if (!c.reason.empty()) {
      return c;
    }
  }
  tell("Finding the command");
  c.plan = plan_correction(c.setting, options);
  if (!c.plan.ok) {
    c.reason = c.plan.reason;
    return c;
  }
  tell("Cutting with the command");
  c.cuts.after = moved_cut(c.setting, c.plan.command.wave);
  c.reason = chatter_in(c.cuts.after, "after");
  if (!c.reason.empty()) {
    return c;
  }
  c.cuts.table_deviation = table_deviation(c.setting, c.plan, c.cuts.after);
  tell("Looking at other speeds");
  c.speeds = speed_map(c.setting, c.plan, options);
  c.axes = axis_limits(
      RigidCut(c.setting.cut.setup, c.setting.cut.law, c.setting.cut.slices),
      options.harmonics);
  c.estimator = estimator_for(c.setting, c.plan.motion);
  if (problem.controller) {
    tell("Running the controller");
    c.controller = controller_in_loop(c.setting, c.plan, *problem.controller);
  }
  c.ok = true;
  return c;
}

}  // namespace trochoid::correction
