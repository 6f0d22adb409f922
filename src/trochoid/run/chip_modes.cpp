#include <trochoid/run/chip_modes.h>

#include <cmath>
#include <numbers>

namespace trochoid::run {

dynamics::System chip_modes(std::span<const inputs::Mode> modes) {
  dynamics::System system;
  for (const inputs::Mode& mode : modes) {
    if (mode.axis == inputs::Axis::z) {
      continue;
    }
    dynamics::ChipMode m;
    const double omega = 2 * std::numbers::pi * mode.frequency.value_or(0.0);
    m.mass = mode.mass ? *mode.mass : *mode.stiffness / (omega * omega);
    m.stiffness = mode.stiffness ? *mode.stiffness : *mode.mass * omega * omega;
    m.damping = mode.damping
                    ? *mode.damping
                    : 2 * *mode.damping_ratio * std::sqrt(m.mass * m.stiffness);
    const double sign = mode.body == inputs::ModeBody::table ? -1.0 : 1.0;
    m.x = mode.axis == inputs::Axis::x ? sign : 0.0;
    m.y = mode.axis == inputs::Axis::y ? sign : 0.0;
    system.modes.push_back(m);
  }
  return system;
}

}  // namespace trochoid::run
