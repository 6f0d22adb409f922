#include <trochoid/run/vibration/problem.h>

#include <trochoid/run/shared/machine.h>

#include <algorithm>

namespace trochoid::run {

namespace {

/// Last turns that are returned.
constexpr int turns_kept = 2;

dynamics::Drive drive_of(const inputs::MachineTables& machine,
                         const dynamics::System& system) {
  const auto table = std::find_if(
      system.modes.begin(), system.modes.end(),
      [](const dynamics::ChipMode& mode) { return mode.of_table && mode.x == -1; });
  return correction::drive_of(plant_of(machine),
                              static_cast<std::size_t>(table - system.modes.begin()));
}

dynamics::ImposedCommand imposed(const inputs::ImposedCommand& command) {
  dynamics::ImposedCommand out{.shape = command.shape,
                               .peak_to_peak = command.peak_to_peak.value_or(0.0),
                               .lead = command.lead};
  if (command.shape == dynamics::CommandShape::table) {
    out.table = command.table.get();
  }
  return out;
}

}  // namespace

dynamics::StabilityOptions stability_options(const inputs::Case& given) {
  return given.machine.stability.value_or(inputs::Stability{}).options;
}

dynamics::StabilityProblem stability_problem(const inputs::Case& given) {
  const inputs::Stability& asked = *given.machine.stability;
  return {.setup = given.setup,
          .law = given.law,
          .system = chip_modes(given.machine.modes),
          .options = stability_options(given),
          .spindle_speeds = base::values(*asked.spindle_speed),
          .depths = base::values(*asked.axial_depth)};
}

dynamics::MotionProblem motion_problem(const inputs::Case& given) {
  dynamics::MotionProblem p{.setup = given.setup,
                            .law = given.law,
                            .system = chip_modes(given.machine.modes)};
  if (given.machine.actuator) {
    p.drive = drive_of(given.machine, p.system);
  }
  if (given.machine.command) {
    p.command = dynamics::command_over_time(imposed(*given.machine.command),
                                            given.setup.cut.Omega);
  }
  p.grid.steps_per_tooth = dynamics::steps_needed(p);
  p.revolutions = static_cast<int>(given.sampling.revolutions);
  p.kept = std::min(p.revolutions, turns_kept);
  p.samples_per_rev = given.sampling.samples_per_rev;
  return p;
}

}  // namespace trochoid::run
