#pragma once

#include <trochoid/base/units.h>
#include <trochoid/correction/moving_cut.h>
#include <trochoid/correction/plant.h>
#include <trochoid/correction/rigid_cut.h>

namespace trochoid::correction {

/// A slot with an 8 mm cutter, 50 um a tooth, 1 mm deep, 1200 rpm.
inline force::Setup slot_with(const std::vector<double>& rho) {
  force::Setup setup;
  setup.cutter = {.profile = geometry::cylinder(8e-3),
                  .pitch = geometry::equal_pitch(static_cast<int>(rho.size())),
                  .lag_diameter = 8e-3};
  setup.cut = {geometry::Slot{}, 1e-3, 50e-6, 1200 * unit::rpm};
  setup.runout.radial_offsets = rho;
  setup.chip.model = chip::Model::radial;
  return setup;
}

/// Exponents so high that 26 um make a difference of 38 %.
inline force::Power steep_law() {
  return {.K_t1 = 166.718603e6, .K_r1 = 58.35151106e6, .m_t = 0.598, .m_r = 0.598};
}

/// Ordinary aluminium.
inline force::Power ordinary_law() {
  return {
      .K_t1 = 420e6, .K_r1 = 95e6, .K_a1 = 60e6, .m_t = 0.28, .m_r = 0.42, .m_a = 0.30};
}

/// The table of the paper, held by its actuator.
inline Plant paper_plant() {
  return held_by_actuator(structure::from_time_constants(0.99536, 1.1303e-3, 1.1376e-3),
                          {.mass = 0.194, .stiffness = 1.7e7, .damping = 77.3});
}

/// A small tool on that table.
inline MovingCut moving_case(double h_ro) {
  const dynamics::ChipMode mode{0.03242277877, 25.46479089, 8e6, 1.0, 0.0};
  MovingCut cut{.setup = slot_with({h_ro / 2, -h_ro / 2}),
                .law = steep_law(),
                .tool = {mode, mode},
                .plant = paper_plant()};
  cut.tool[1].x = 0.0;
  cut.tool[1].y = 1.0;
  return cut;
}

}  // namespace trochoid::correction
