#pragma once

#include <trochoid/force/form.h>

#include <span>
#include <string_view>

namespace trochoid::force {

/// @brief Kienzle's power law: a thin chip costs more per thickness.
/// @eq F-2 dF_q = K_q1 h_0 (h sin(kappa) / h_0)^(1 - m_q) ds, q in {t, r, a}
/// @src [kienzle1952]
struct Power {
  double K_t1 = 0.0;  ///< [N/m^2]
  double K_r1 = 0.0;  ///< [N/m^2]
  double K_a1 = 0.0;  ///< [N/m^2]
  double m_t = 0.0;   ///< in [-0.5, 1)
  double m_r = 0.0;   ///< in [-0.5, 1)
  double m_a = 0.0;   ///< in [-0.5, 1)
};

constexpr std::string_view name_of(const Power& /*law*/) noexcept {
  return "power";
}
Form form(const Power& law) noexcept;
/// Its numbers, in the order of files.
std::span<const Number<Power>> numbers(const Power& law) noexcept;

}  // namespace trochoid::force
