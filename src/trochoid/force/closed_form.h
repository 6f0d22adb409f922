#pragma once

#include <trochoid/force/forces.h>

#include <optional>

namespace trochoid::force {

/// @brief Mean force over a turn of a slot without
/// runout, by a formula one can do by hand.
///
/// @eq F-8 mean F_x = -N a_p (K_rc f_z/4 + K_re e/pi),
///         F_y = N a_p (K_tc f_z/4 + K_te e/pi),
///         F_z = -N a_p (K_ac f_z/pi + K_ae e/2), e = dS/dz = 1/cos(helix)
/// @src derived; any helix and number of equal or unequal teeth
/// @return [N]; absent unless it is a slot with a cylinder, no
/// runout, a linear law and a chip of f_z sin(theta)
std::optional<Vector3> closed_form_mean(const Setup& setup, const Law& law);

}  // namespace trochoid::force
