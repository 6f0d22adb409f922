#include <trochoid/run/correct/problem.h>

#include <trochoid/base/error.h>
#include <trochoid/run/shared/machine.h>
#include <trochoid/run/shared/records.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace trochoid::run {

namespace {

correction::MovingCut moving_cut(const inputs::Case& given) {
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

correction::ForceRecord record_of(const inputs::Case& given,
                                  std::vector<base::Warning>& warnings) {
  const auto runs = measured_runs(given, warnings);
  for (const MeasuredRun& one : runs) {
    if (std::ranges::all_of(one.run.measured, std::identity())) continue;
    throw base::InputError(
        {one.file + ": not all three channels were measured; must hold three forces"});
  }
  const auto M = given.dynamometer.value_or(inputs::Dynamometer{}).matrix;
  identification::Run run = identification::on_tool(channels_of(runs), M).front();
  return {std::move(run.angle), std::move(run.force)};
}

}  // namespace

correction::CorrectionProblem correction_problem(const inputs::Case& given,
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

}  // namespace trochoid::run
