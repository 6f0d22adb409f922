#include "paper_cut.h"

#include <trochoid/base/units.h>

namespace trochoid::benchmarks {

force::Setup paper_cut(chip::Model model) {
  force::Setup setup;
  setup.cutter = {.profile = geometry::cylinder(8 * unit::mm),
                  .pitch = geometry::equal_pitch(2),
                  .helix = 30 * unit::deg,
                  .lag_diameter = 8 * unit::mm};
  setup.runout.radial_offsets = {0.0, -8 * unit::um};
  setup.cut = {.engagement = geometry::Slot{},
               .a_p = 2 * unit::mm,
               .f_z = 0.04 * unit::mm,
               .Omega = 875 * unit::rpm};
  setup.chip = {model, chip::Lookback::all};
  return setup;
}

force::Law paper_law() {
  return force::LinearEdge{.K_tc = 2620 * unit::MPa,
                           .K_rc = 1560 * unit::MPa,
                           .K_ac = 331 * unit::MPa,
                           .K_te = 7 * unit::N_per_mm,
                           .K_re = 3 * unit::N_per_mm,
                           .K_ae = 1 * unit::N_per_mm};
}

std::vector<double> turns(int samples_per_turn, int count) {
  std::vector<double> phi;
  for (int i = 0; i < samples_per_turn * count; ++i) {
    phi.push_back((0.137 + i * 360.0 / samples_per_turn) * unit::deg);
  }
  return phi;
}

}  // namespace trochoid::benchmarks
