#pragma once

#include <trochoid/chip/chip.h>

namespace trochoid::chip {

/// @brief Material that a slice removes in one turn, and what there is to remove.
struct Removal {
  double removed = 0.0;    ///< area [m^2]
  double available = 0.0;  ///< feed per turn times the width of cut [m^2]
};

/// @brief What the chips of all teeth add up to in one turn of the trochoidal model.
///
/// @eq C-8 sum over teeth of the integral of (o^2 - L^2)/2 + (f/2 pi) cos(theta)
///         (o - L) over theta = f times the width of cut, o and L the ends of the
///         chip on its ray
/// @src derived from the area that a ray sweeps while its centre moves along x
/// @note At a full edge of the cut a cusp of about f^2/(12 R) in width stays behind.
Removal removal(const Passage& passage, const Slice& slice);

}  // namespace trochoid::chip
