#include <trochoid/run/chip_modes.h>

#include <trochoid/structure/mode.h>

namespace trochoid::run {

dynamics::System chip_modes(std::span<const inputs::Mode> modes) {
  dynamics::System system;
  for (const inputs::Mode& mode : modes) {
    if (mode.axis == inputs::Axis::z) {
      continue;
    }
    const structure::Mode whole = structure::completed(
        {mode.mass, mode.stiffness, mode.damping, mode.frequency, mode.damping_ratio});
    dynamics::ChipMode m{whole.mass, whole.damping, whole.stiffness};
    const double sign = mode.body == inputs::ModeBody::table ? -1.0 : 1.0;
    m.x = mode.axis == inputs::Axis::x ? sign : 0.0;
    m.y = mode.axis == inputs::Axis::y ? sign : 0.0;
    system.modes.push_back(m);
  }
  return system;
}

}  // namespace trochoid::run
