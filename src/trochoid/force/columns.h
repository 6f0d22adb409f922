#pragma once

#include <trochoid/force/law.h>

#include <array>

namespace trochoid::force {

/// Reference chip thickness of the power law [m].
inline constexpr double h_0 = 1e-3;

/// @brief How strongly an edge element pulls in t, r, a for unit coefficients, per ds.
struct ColumnWeights {
  std::array<double, 3> cutting{};  ///< h sin(kappa), or w_q, for t, r, a [m]
  double edge = 0.0;                ///< dS/ds, or 0 in a power law
};

/// @brief Weights of one element per meridian length ds, zero chip excluded.
///
/// @eq F-1 dF_q = K_qc h dz + K_qe dS             (linear_edge; h along the ray)
/// @eq F-2 dF_q = K_q1 h_0 (h sin(kappa) / h_0)^(1 - m_q) ds   (power)
/// @src [riviere2009] eq. 14; Kienzle
/// @param h          along the horizontal ray [m], positive
/// @param sin_kappa  dz/ds
/// @param dS         edge length per ds, as the setup asks
ColumnWeights column_weights(const Law& law, double h, double sin_kappa,
                             double dS) noexcept;

}  // namespace trochoid::force
