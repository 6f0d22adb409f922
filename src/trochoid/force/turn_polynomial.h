#pragma once

#include <trochoid/force/law.h>
#include <trochoid/force/turn_teeth.h>
#include <trochoid/numerics/piecewise_integral.h>

#include <array>
#include <span>
#include <vector>

namespace trochoid::force {

/// Three functions at once; the fourth number pads to whole vectors.
using Triple = std::array<double, 4>;

/// @brief What is summed along the edges: three functions
/// h (h_cos cos + h_sin sin + h_one) + e (e_cos cos + e_sin sin + e_one) of theta, with
/// e = dS/dz where in cut.
struct TurnWeights {
  Triple h_cos{};
  Triple h_sin{};
  Triple h_one{};
  Triple e_cos{};
  Triple e_sin{};
  Triple e_one{};
};

/// The force in x, y, z by F-1 and F-3 with sin(kappa) = 1.
/// @param law  whose form is linear in the chip
TurnWeights force_weights(const Terms& law) noexcept;
/// The integrals of h sin, h cos, h.
TurnWeights chip_weights() noexcept;
/// The integrals of e sin, e cos, e.
TurnWeights edge_weights() noexcept;

/// @brief A short stretch of phi on which something is a polynomial of
/// t = (phi - from) per_half - 1, cut to [-1, 1].
struct TurnPanel {
  double from = 0.0;                                       ///< where t = -1 [rad]
  double per_half = 0.0;                                   ///< dt/dphi [1/rad]
  std::array<Triple, numerics::panel_nodes + 1> powers{};  ///< of t^0, t^1 ...
};

/// @brief Three functions of the spindle angle over a whole turn, between few angles
/// one trigonometric polynomial and a linear term each.
///
/// @eq F-12 F = A + B phi + sum over k of A_k cos(k phi) + B_k sin(k phi)
/// @src derived from F-11
///
/// Its segments go from 0 to 2 pi. A value at the end of a segment is that of the next.
struct TurnPolynomial {
  int highest = 0;           ///< harmonic
  std::vector<double> ends;  ///< of the segments, ascending [rad]; the last is 2 pi
  /// Factors of 1, phi, cos(phi), sin(phi), cos(2 phi) ... of each segment, shape
  /// (segments, terms_of_segment())
  std::vector<Triple> terms;
  std::vector<TurnPanel> panels;  ///< added on their segments
  /// Places of the panels of segment i: panel_places[first_panel[i]] up to, not
  /// including, panel_places[first_panel[i + 1]].
  std::vector<int> panel_places;
  std::vector<int> first_panel;  ///< shape (segments + 1)

  [[nodiscard]] std::size_t terms_of_segment() const noexcept {
    return 2 + 2 * static_cast<std::size_t>(highest);
  }
};

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
