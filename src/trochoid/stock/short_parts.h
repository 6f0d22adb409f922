#pragma once

#include <trochoid/geometry/arcs.h>
#include <trochoid/stock/slice_part.h>

#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::stock {

/// Whether a part is level, straight, and short beside a circle of radius r about the axis.
bool is_short(const SlicePart& part, double r) noexcept;

/// What short parts cover of a circle.
struct ShortParts {
  bool all_around = false;  ///< they cover all of it
  std::vector<geometry::Arc>
      covered;                       ///< arcs that end inside of what they cover [rad]
  std::vector<std::size_t> exactly;  ///< parts that have to be looked at one by one
};

/// @brief What many short parts cover of a circle of radius r about the axis.
///
/// A path of a thousand short blocks passes a cutter. Discs at the ends of its parts cover
/// nearly all that the parts do, and most of them lie deep in what others cover. Only parts
/// near the ends of what all discs cover together have to be looked at exactly: these, and
/// the arcs, cover what all parts cover.
/// @param parts  in the order of the path
ShortParts short_parts(std::span<const SlicePart> parts, double r);

}  // namespace trochoid::stock
