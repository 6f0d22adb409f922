#pragma once

#include <trochoid/force/law.h>
#include <trochoid/force/turn_teeth.h>
#include <trochoid/force/turn_terms.h>

namespace trochoid::force {

/// The force in x, y, z by F-1 and F-3 with sin(kappa) = 1.
/// @param law  whose form is linear in the chip
TurnWeights force_weights(const Terms& law) noexcept;
/// The torque about the spindle axis by F-6 as the third function, positive where the
/// spindle drives.
TurnWeights torque_weights(const Terms& law) noexcept;
/// The integrals of h sin, h cos, h.
TurnWeights chip_weights() noexcept;
/// The integrals of e sin, e cos, e.
TurnWeights edge_weights() noexcept;

/// @brief Sums along all edges, for every angle of the tip of tooth 1.
///
/// @eq F-10 G_j = a_0 theta + sum over k of (a_k sin(k theta) - b_k cos(k theta))/k, a_k,
///          b_k the harmonics of g_j
/// @eq F-11 a piece from b_1 to b_2 adds lead sum over its ends b of +-{[G_j(phi - psi_j) -
///          G_j(b)] from phi = b + psi_j on, less [G_j(phi - psi_j - lag) - G_j(b)] from
///          b + psi_j + lag on}, + at b_1, - at b_2
/// @eq F-13 F_j = a_p g_j(phi - psi_j - lag/2) of a lag below 1e-6 with both ends of the
///          edge in one piece; between pieces the share in cut grows by degrees
/// @src derived from F-5
TurnPolynomial turn_polynomial(const TurnTeeth& teeth, const TurnWeights& weights);

}  // namespace trochoid::force
