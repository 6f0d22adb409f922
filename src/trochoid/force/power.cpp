#include <trochoid/force/power.h>

#include <trochoid/base/units.h>

#include <array>

namespace trochoid::force {

Form form(const Power& law) noexcept {
  return {.power = true, .m = {law.m_t, law.m_r, law.m_a}};
}

std::span<const Number<Power>> numbers(const Power& /*law*/) noexcept {
  using unit::MPa;
  using unit::one;
  static constexpr std::array<Number<Power>, 6> all = {
      {{{"K_t1_MPa", "tangential pressure at a chip of 1 mm", MPa, Role::cutting,
         false},
        &Power::K_t1},
       {{"m_t", "tangential exponent", one, Role::exponent}, &Power::m_t},
       {{"K_r1_MPa", "radial pressure at a chip of 1 mm", MPa, Role::cutting},
        &Power::K_r1},
       {{"m_r", "radial exponent", one, Role::exponent}, &Power::m_r},
       {{"K_a1_MPa", "axial pressure at a chip of 1 mm", MPa, Role::cutting},
        &Power::K_a1},
       {{"m_a", "axial exponent", one, Role::exponent}, &Power::m_a}}};
  return all;
}

}  // namespace trochoid::force
