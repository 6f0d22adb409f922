#pragma once

#include <trochoid/chip/chip.h>
#include <trochoid/numerics/trig_polynomial.h>

#include <optional>
#include <vector>

namespace trochoid::chip {

/// @brief A stretch of a turn in which one mark bounds the chip of a tooth.
struct HarmonicPiece {
  double from = 0.0;  ///< effective theta [rad]
  double to = 0.0;    ///< effective theta [rad]
  int mark = 0;       ///< teeth before, 1 ... teeth: whose polynomial it is
  /// Whether the edge of the stock cuts the chip short: the polynomial is then no more
  /// than what there would be without it.
  bool at_stock_edge = false;
};

/// @brief Where and how one tooth cuts in a turn, by trigonometric polynomials.
struct ToothHarmonics {
  /// R_j - L_k of the marks 1, 2 ... that matter; the others are empty.
  std::vector<std::optional<numerics::TrigPolynomial>> over_mark;
  std::vector<HarmonicPiece> pieces;  ///< ascending, within [-90, 270] deg
};

/// @brief The pieces of a tooth, as engaged_pieces finds them, in closed form but for
/// Newton's steps.
/// @param tolerance  error allowed in the chip [m]
/// @return nothing where the chip is no such polynomial (see harmonics_over_mark)
std::optional<ToothHarmonics> tooth_harmonics(const Passage& passage,
                                              const Slice& slice, int tooth,
                                              double tolerance);

}  // namespace trochoid::chip
