#include <trochoid/results/process_damping.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

namespace trochoid::results {

Object process_damping_value(const force::ProcessDamping& damping) {
  return {
      {"wear_land_um", unit::in(damping.wear_land, unit::um)},
      {"indentation_N_per_mm3", unit::in(damping.indentation, unit::N_per_mm3)},
      {"flank_friction", damping.friction},
  };
}

std::string process_damping_text(const force::ProcessDamping& damping) {
  return fmt::format("process damping of a wear land of {:g} um",
                     unit::in(damping.wear_land, unit::um));
}

}  // namespace trochoid::results
