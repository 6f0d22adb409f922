#include <trochoid/run/machine_plant.h>

#include <algorithm>
#include <stdexcept>

namespace trochoid::run {

namespace {

structure::ActuatorDynamics dynamics_of(const inputs::Actuator& a) {
  return a.frequency ? structure::from_frequency(a.gain, *a.frequency, *a.damping_ratio)
                     : structure::from_time_constants(a.gain, a.time_constants[0],
                                                      a.time_constants[1]);
}

}  // namespace

correction::Plant plant_of(const inputs::MachineTables& machine) {
  const auto table = std::find_if(
      machine.modes.begin(), machine.modes.end(), [](const inputs::Mode& mode) {
        return mode.body == inputs::ModeBody::table && mode.axis == inputs::Axis::x;
      });
  if (!machine.actuator || table == machine.modes.end()) {
    throw std::invalid_argument("plant_of: no actuator, or no table along x");
  }
  const structure::Mode mode =
      structure::completed({table->mass, table->stiffness, table->damping,
                            table->frequency, table->damping_ratio});
  correction::Plant plant =
      correction::held_by_actuator(dynamics_of(*machine.actuator), mode);
  if (machine.actuator->coupling_stiffness) {
    const double share = *machine.actuator->coupling_stiffness / mode.stiffness;
    plant.k_s = *machine.actuator->coupling_stiffness;
    plant.c_s = share * mode.damping;
  }
  plant.c_s = machine.actuator->coupling_damping.value_or(plant.c_s);
  return plant;
}

correction::ActuatorLimits limits_of(const inputs::Actuator& actuator) {
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

}  // namespace trochoid::run
