#include <trochoid/force/linear_edge.h>

#include <trochoid/base/units.h>

#include <array>

namespace trochoid::force {

Form form(const LinearEdge& /*law*/) noexcept {
  return {.edge = true};
}

std::span<const Number<LinearEdge>> numbers(const LinearEdge& /*law*/) noexcept {
  using unit::MPa;
  using unit::N_per_mm;
  using Law = LinearEdge;
  static constexpr std::array<Number<Law>, 6> all = {
      {{{"K_tc_MPa", "tangential cutting coefficient", MPa, Role::cutting, false},
        &Law::K_tc},
       {{"K_rc_MPa", "radial cutting coefficient", MPa, Role::cutting}, &Law::K_rc},
       {{"K_ac_MPa", "axial cutting coefficient", MPa, Role::cutting}, &Law::K_ac},
       {{"K_te_N_per_mm", "tangential edge coefficient", N_per_mm, Role::edge},
        &Law::K_te},
       {{"K_re_N_per_mm", "radial edge coefficient", N_per_mm, Role::edge}, &Law::K_re},
       {{"K_ae_N_per_mm", "axial edge coefficient", N_per_mm, Role::edge},
        &Law::K_ae}}};
  return all;
}

}  // namespace trochoid::force
