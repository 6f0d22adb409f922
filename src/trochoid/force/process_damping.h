#pragma once

#include <trochoid/force/form.h>

namespace trochoid::force {

/// @brief What the worn flank of an edge does to a vibration: process damping.
///
/// The wear land follows the edge at its clearance angle of zero. A tooth that moves into
/// the work while it travels presses material under the land; one that moves out of it is
/// pressed less. Per height of edge the volume is that of a triangle of base L_w and slope
/// rdot/v, and the force is proportional to it:
///
/// @eq  F-16 f_r = K_sp (L_w^2 / 2) rdot / v,  f_t = mu f_r,
///           rdot = n . dq/dt the speed into the work, v = R Omega that of the cut
/// @src [wu1989], small amplitudes after [chiou1998]
/// @note Linear in rdot, so it also pulls where the tooth moves out of the work: what the
///       land loses of the force that it has without vibration. That force itself is among
///       the edge coefficients.
struct ProcessDamping {
  double wear_land = 0.0;    ///< L_w [m], not negative; 0: a sharp edge
  double indentation = 0.0;  ///< K_sp, force per volume pressed [N/m^3], not negative
  double friction = 0.0;     ///< mu of flank and work, not negative

  /// Does it make any force?
  [[nodiscard]] constexpr bool acts() const noexcept {
    return wear_land > 0 && indentation > 0;
  }
};

/// @brief F-16 as a law: what the forces of a chip of rdot/v would be.
/// @return linear, without edge forces; its K [N/m] of t, r, a
constexpr Terms damping_terms(const ProcessDamping& damping) noexcept {
  const double c = 0.5 * damping.indentation * damping.wear_land * damping.wear_land;
  return {.form = {}, .K = {damping.friction * c, c, 0.0}, .K_e = {}};  // F-16
}

}  // namespace trochoid::force
