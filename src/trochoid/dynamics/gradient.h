#pragma once

#include <trochoid/force/form.h>

#include <array>

namespace trochoid::dynamics {

/// 2 x 2, row-major.
using Matrix2 = std::array<double, 4>;

/// @brief How the force on the tool in x and y changes when the tool moves in x and y,
/// per meridian length.
///
/// The chip grows by n . dq, n = (sin theta, cos theta), the outward normal.
///
/// @eq D-5 dF_q/dh = K_qc sin(kappa)                                   (linear_edge)
/// @eq D-6 dF_q/dh = K_q1 (1 - m_q) sin(kappa) (h sin(kappa) / h_0)^(-m_q)
///         (power, power_edge)
/// @eq D-7 g = [B]_xy (dF_t/dh, dF_r/dh, dF_a/dh)^T n^T
/// @src D-5, D-6: derivatives of F-1, F-2; D-7: F-3, and the
/// chip of [diez2010] eq. 14 in the axes of docs/notation.md
/// @param h  along the horizontal ray [m], at least the floor of D-6
/// @return [N/m^2]
Matrix2 directional_gradient(const force::Terms& law, double h, double theta,
                             double sin_kappa, double cos_kappa) noexcept;

}  // namespace trochoid::dynamics
