#pragma once

#include <trochoid/chip/chip.h>

#include <memory_resource>
#include <vector>

namespace trochoid::chip {

/// @brief The marks that can bound the chip of a tooth anywhere in a turn; the others lie
/// behind one of them for certain.
///
/// By bounds of the chip over each mark (estimate_over_mark): safe, not sharp.
/// @pre the feed of a turn is at most 2 pi `largest_feed` times each radius, where the
///      bounds of the exact chip hold
/// @return teeth before, 1 ... passage.marks, ascending
std::pmr::vector<int> near_marks(
    const Passage& passage, const Slice& slice, int tooth,
    std::pmr::memory_resource& memory = *std::pmr::get_default_resource());

}  // namespace trochoid::chip
