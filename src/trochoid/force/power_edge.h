#pragma once

#include <trochoid/force/form.h>

#include <span>
#include <string_view>

namespace trochoid::force {

/// @brief Kienzle's power law for cutting, and an edge force wherever an edge cuts.
/// @eq F-9 dF_q = K_q1 h_0 (h sin(kappa) / h_0)^(1 - m_q) ds + K_qe dS, q in {t, r, a}
/// @src F-2 with the edge force of F-1
/// @note m near 1 and an edge force are told apart by thick chips only.
struct PowerEdge {
  double K_t1 = 0.0;  ///< [N/m^2]
  double K_r1 = 0.0;  ///< [N/m^2]
  double K_a1 = 0.0;  ///< [N/m^2]
  double m_t = 0.0;   ///< in [-0.5, 1)
  double m_r = 0.0;   ///< in [-0.5, 1)
  double m_a = 0.0;   ///< in [-0.5, 1)
  double K_te = 0.0;  ///< [N/m]
  double K_re = 0.0;  ///< [N/m]
  double K_ae = 0.0;  ///< [N/m]
};

constexpr std::string_view name_of(const PowerEdge& /*law*/) noexcept {
  return "power_edge";
}
Form form(const PowerEdge& law) noexcept;
/// Its numbers, in the order of files.
std::span<const Number<PowerEdge>> numbers(const PowerEdge& law) noexcept;

}  // namespace trochoid::force
