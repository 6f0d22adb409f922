#pragma once

#include <trochoid/force/turn_polynomial.h>

#include <vector>

namespace trochoid::force {

/// @brief A stretch of theta on which the edge of the stock cuts the chip short, as a
/// polynomial of t in [-1, 1].
struct StockEdge {
  double from = 0.0;                                         ///< effective theta [rad]
  double to = 0.0;                                           ///< effective theta [rad]
  std::array<Triple, numerics::panel_nodes + 1> integral{};  ///< from `from` on

  [[nodiscard]] double half() const noexcept { return 0.5 * (to - from); }
};

/// Add as many as a piece of a tooth needs.
void add_stock_edges(const TurnTeeth& teeth, const TurnWeights& weights,
                     std::size_t tooth, const chip::HarmonicPiece& piece,
                     std::vector<StockEdge>& out);

/// The integral over all of it.
Triple total(const StockEdge& edge) noexcept;

/// The integrand as a polynomial of t.
std::array<Triple, numerics::panel_nodes + 1> integrand(const StockEdge& edge) noexcept;

}  // namespace trochoid::force
