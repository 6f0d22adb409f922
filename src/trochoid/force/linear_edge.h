#pragma once

#include <trochoid/force/form.h>

#include <span>
#include <string_view>

namespace trochoid::force {

/// @brief Force in proportion to the chip, and an edge force wherever an edge cuts.
/// @eq F-1 dF_q = K_qc h dz + K_qe dS, q in {t, r, a}; h along the ray
/// @src [riviere2009] eq. 14, the linear edge-force model of [altintas2000]
struct LinearEdge {
  double K_tc = 0.0;  ///< [N/m^2]
  double K_rc = 0.0;  ///< [N/m^2]
  double K_ac = 0.0;  ///< [N/m^2]
  double K_te = 0.0;  ///< [N/m]
  double K_re = 0.0;  ///< [N/m]
  double K_ae = 0.0;  ///< [N/m]
};

constexpr std::string_view name_of(const LinearEdge& /*law*/) noexcept {
  return "linear_edge";
}
Form form(const LinearEdge& law) noexcept;
/// Its numbers, in the order of files.
std::span<const Number<LinearEdge>> numbers(const LinearEdge& law) noexcept;

}  // namespace trochoid::force
