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
/// has none.
/// @param sine_cosine  of the angle of the tip of tooth 1
void tip_chips(const NodePanels& all, const NodeTooth& tooth,
               std::array<double, 2> sine_cosine, TipChips& out) noexcept;

/// @brief Polynomials at eight places.
/// @param powers    of each of `rows` polynomials, node_room apart
/// @param t         shape (8)
/// @param[out] out  shape (rows, 8)
void tip_polynomials(std::span<const NodeRow> powers, const double* t,
                     double* out) noexcept;

}  // namespace trochoid::force
