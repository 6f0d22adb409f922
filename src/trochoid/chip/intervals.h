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

/// An arc of nominal theta [rad].
struct Arc {
  double from = 0.0;
  double to = 0.0;
};

/// @brief The arcs in which a slice of a tooth cuts, `from` in [-90, 270) deg.
std::vector<Arc> engaged_arcs(const Passage& passage, const Slice& slice, int tooth);

}  // namespace trochoid::chip
