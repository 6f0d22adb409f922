#include <trochoid/run/problems.h>

#include <trochoid/dynamics/motion.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trochoid::run {

namespace {

structure::Mode whole_mode(const cases::Mode& mode) {
  return structure::completed(
      {mode.mass, mode.stiffness, mode.damping, mode.frequency, mode.damping_ratio});
}

structure::ActuatorDynamics dynamics_of(const cases::Actuator& a) {
  return a.frequency ? structure::from_frequency(a.gain, *a.frequency, *a.damping_ratio)
                     : structure::from_time_constants(a.gain, a.time_constants[0],
                                                      a.time_constants[1]);
}

/// Last turns that are returned.
constexpr int turns_kept = 2;

dynamics::Drive drive_of(const cases::MachineTables& machine,
                         const dynamics::System& system) {
  const auto table = std::find_if(
      system.modes.begin(), system.modes.end(),
      [](const dynamics::ChipMode& mode) { return mode.of_table && mode.x == -1; });
  return correction::drive_of(plant_of(machine),
                              static_cast<std::size_t>(table - system.modes.begin()));
}

dynamics::ImposedCommand imposed(const cases::ImposedCommand& command) {
  dynamics::ImposedCommand out{.shape = command.shape,
                               .peak_to_peak = command.peak_to_peak.value_or(0.0),
                               .lead = command.lead};
  if (command.shape == dynamics::CommandShape::table) {
    out.table = command.table.get();
  }
  return out;
}

}  // namespace

dynamics::System chip_modes(std::span<const cases::Mode> modes) {
  dynamics::System system;
  for (const cases::Mode& mode : modes) {
    if (mode.axis == cases::Axis::z) {
      continue;
    }
    const structure::Mode whole = whole_mode(mode);
    dynamics::ChipMode m{whole.mass, whole.damping, whole.stiffness};
    const double sign = mode.body == cases::ModeBody::table ? -1.0 : 1.0;
    const double along = sign * std::cos(mode.angle);
    const double across = sign * std::sin(mode.angle);
    const bool is_x = mode.axis == cases::Axis::x;
    m.x = is_x ? along : -across;
    m.y = is_x ? across : along;
    m.of_table = sign < 0;
    system.modes.push_back(m);
  }
  return system;
}

correction::Plant plant_of(const cases::MachineTables& machine) {
  const auto table = std::find_if(
      machine.modes.begin(), machine.modes.end(), [](const cases::Mode& mode) {
        return mode.body == cases::ModeBody::table && mode.axis == cases::Axis::x &&
               mode.angle == 0;
      });
  if (!machine.actuator || table == machine.modes.end()) {
    throw std::invalid_argument("plant_of: no actuator, or no table along x");
  }
  const structure::Mode mode = whole_mode(*table);
  correction::Plant plant =
      correction::held_by_actuator(dynamics_of(*machine.actuator), mode);
  if (machine.actuator->coupling_stiffness) {
    const double fraction = *machine.actuator->coupling_stiffness / mode.stiffness;
    plant.k_s = *machine.actuator->coupling_stiffness;
    plant.c_s = fraction * mode.damping;
  }
  plant.c_s = machine.actuator->coupling_damping.value_or(plant.c_s);
  return plant;
}

correction::ActuatorLimits limits_of(const cases::Actuator& actuator) {
  correction::ActuatorLimits limits{.slew = actuator.slew,
                                    .push = actuator.push,
                                    .pull = actuator.pull,
                                    .most_frequency = actuator.highest_frequency};
  if (actuator.stroke.size() == 2) {
    limits.stroke_low = actuator.stroke[0];
    limits.stroke_high = actuator.stroke[1];
  }
  return limits;
}

std::string too_many_steps(int steps_per_tooth) {
  return fmt::format(
      "the fastest mode would need {} steps a tooth, more than the {} that are "
      "computed: leave out modes far above the tooth frequency",
      steps_per_tooth, dynamics::most_steps);
}

dynamics::StabilityOptions stability_options(const cases::Case& given) {
  return given.machine.stability.value_or(cases::Stability{}).options;
}

dynamics::StabilityProblem stability_problem(const cases::Case& given) {
  const cases::Stability& asked = *given.machine.stability;
  return {.setup = given.setup,
          .law = given.law,
          .system = chip_modes(given.machine.modes),
          .options = stability_options(given),
          .spindle_speeds = base::values(*asked.spindle_speed),
          .depths = base::values(*asked.axial_depth)};
}

dynamics::MotionProblem motion_problem(const cases::Case& given) {
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
