#pragma once

#include <trochoid/dynamics/period_elements.h>

namespace trochoid::dynamics {

/// @brief One number a node where that is enough: as long as one tooth cuts at a time,
/// and that without helix, nothing counts but the motion along its normal, and its force
/// has one direction.
///
/// @eq D-15 A_d = alpha_d u n^T for all delays;  w = n . q,
///          F = u (alpha_0 w - sum over d of alpha_d w(phi - d))
/// @src derived: n is the same a pitch before, where the tooth before was
/// @param[in,out] elements  in two components; then in one, if all of their matrices are
///                          such products
void follow_normals(PeriodElements& elements);

}  // namespace trochoid::dynamics
