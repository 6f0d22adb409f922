#pragma once

#include <trochoid/numerics/piecewise_integral.h>

#include <array>
#include <cstddef>
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
  /// Whether the third function is also times the distance of the tooth from the axis [m].
  bool arm_on_third = false;
};

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

}  // namespace trochoid::force
