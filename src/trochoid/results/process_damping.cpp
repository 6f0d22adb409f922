#include <trochoid/results/process_damping.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

namespace trochoid::results {

const Fields<force::ProcessDamping>& process_damping_fields() {
  using Of = const force::ProcessDamping&;
  static const Fields<force::ProcessDamping> all{
      {"wear_land_um", "of the flank", [](Of d) { return given(d.wear_land); }},
      {"indentation_N_per_mm3", "force over the volume that the flank presses aside",
       [](Of d) { return given(d.indentation); }},
      {"flank_friction", "friction over that force", &force::ProcessDamping::friction}};
  return all;
}

std::string process_damping_text(const force::ProcessDamping& damping) {
  return fmt::format("process damping of a wear land of {:g} um",
                     unit::in(damping.wear_land, unit::um));
}

}  // namespace trochoid::results
