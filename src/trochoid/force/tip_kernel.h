#pragma once

#include <trochoid/force/node_kernel.h>

#include <array>
#include <span>
#include <vector>

namespace trochoid::force {

/// A chip over a mark that is not there: any other is thinner [m].
inline constexpr double no_mark = 1e300;

/// What eight places see of one tooth at one spindle angle.
struct TipChips {
  NodeChips chips;
  std::vector<double> there;  ///< how surely each mark is there, negative: it is not;
                              ///< shape (marks, 8)
};

/// @brief Chips over all marks at the nodes of a panel, near the axis as well.
///
/// C-5 by Newton's method from the side on which it cannot pass the root; no_mark where it
/// has none. The least chip is the distance from the axis where no mark is closer.
/// @pre the rule has eight nodes, the chip model is trochoidal, and no stock is near
/// @param tooth        rows of NodeTooth at the eight places; `back` in (0, turn]
/// @param sine_cosine  of the angle of the tip of tooth 1
/// @param[out] out     with room for all marks
void tip_chips(const NodePanels& all, const NodeTooth& tooth,
               std::array<double, 2> sine_cosine, TipChips& out) noexcept;

/// @brief Polynomials at eight places of a panel: the rows of a tooth between its nodes.
///
/// @param powers    factors of 1, t, t^2 ... t^7 of each, as powers_of gives them
/// @param t         from -1 to 1, shape (8)
/// @param[out] out  as rows of NodeTooth, shape (polynomials, 8)
void tip_polynomials(std::span<const NodeRow> powers, const double* t,
                     double* out) noexcept;

}  // namespace trochoid::force
