#include <trochoid/force/power_edge.h>

#include <trochoid/base/units.h>

#include <array>

namespace trochoid::force {

Form form(const PowerEdge& law) noexcept {
  return {.power = true, .m = {law.m_t, law.m_r, law.m_a}, .edge = true};
}

std::span<const Number<PowerEdge>> numbers(const PowerEdge& /*law*/) noexcept {
  using unit::MPa;
  using unit::N_per_mm;
  using unit::one;
  using Law = PowerEdge;
  static constexpr std::array<Number<Law>, 9> all = {
      {{{"K_t1_MPa", "tangential pressure at a chip of 1 mm", MPa, Role::cutting,
         false},
        &Law::K_t1},
       {{"m_t", "tangential exponent", one, Role::exponent}, &Law::m_t},
       {{"K_r1_MPa", "radial pressure at a chip of 1 mm", MPa, Role::cutting},
        &Law::K_r1},
       {{"m_r", "radial exponent", one, Role::exponent}, &Law::m_r},
       {{"K_a1_MPa", "axial pressure at a chip of 1 mm", MPa, Role::cutting},
        &Law::K_a1},
       {{"m_a", "axial exponent", one, Role::exponent}, &Law::m_a},
       {{"K_te_N_per_mm", "tangential edge coefficient", N_per_mm, Role::edge},
        &Law::K_te},
       {{"K_re_N_per_mm", "radial edge coefficient", N_per_mm, Role::edge}, &Law::K_re},
       {{"K_ae_N_per_mm", "axial edge coefficient", N_per_mm, Role::edge},
        &Law::K_ae}}};
  return all;
}

}  // namespace trochoid::force
