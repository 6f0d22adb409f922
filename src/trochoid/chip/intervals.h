#pragma once

#include <trochoid/chip/chip.h>
#include <trochoid/numerics/pieces.h>

#include <vector>

namespace trochoid::chip {

/// A chip as a state of numerics::PieceFinder.
struct ChipState {
  Chip chip;
  [[nodiscard]] bool active() const noexcept { return chip.in_cut; }
  [[nodiscard]] int branch() const noexcept { return chip.bounds; }
  [[nodiscard]] double margin() const noexcept { return chip.margin; }
};

using ChipPiece = numerics::Piece<ChipState>;

/// @brief Where a slice of a tooth cuts in one
/// turn, cut at every change of what bounds it.
/// @param start  nominal theta where the turn starts [rad]
/// @return ascending, within [start, start + 2 pi]; h is smooth in each
std::vector<ChipPiece> engaged_pieces(const Passage& passage, const Slice& slice,
                                      int tooth, double start);

using geometry::Arc;

/// @brief Entry and exit angle: where a tooth of its own radius is in the stock.
///
/// @eq R-2 cos(theta_st) = y_hi/R_j, cos(theta_ex) = y_lo/R_j, within [0, pi]
/// @src [diez2010], reconstructed; G-11 with the radius of the tooth
/// @param D    nominal diameter, to which the radial depth refers [m]
/// @param R_j  [m], positive
Arc tooth_arc(const geometry::Engagement& engagement, double D, double R_j);

/// @brief The arcs in which a slice of a tooth cuts, `from` in [-90, 270) deg.
std::vector<Arc> engaged_arcs(const Passage& passage, const Slice& slice, int tooth);

}  // namespace trochoid::chip
