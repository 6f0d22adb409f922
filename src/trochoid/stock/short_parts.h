#pragma once

#include <trochoid/geometry/arcs.h>
#include <trochoid/stock/slice_part.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

/// What many discs cover of a circle about the axis.
namespace trochoid::stock {

/// What a disc covers of a circle of radius r about the axis; nothing where it does not cross
/// it.
std::optional<geometry::Arc> disc_arc(const SlicePoint& at, double R,
                                      double r) noexcept;

/// The union of arcs.
std::vector<geometry::Arc> joined(std::vector<geometry::Arc> arcs);

/// Whether an arc is a whole circle.
bool goes_round(const geometry::Arc& arc) noexcept;

/// A chain of pieces in the frame of a cutter.
struct NearChain {
  std::size_t place = 0;  ///< among all chains
  SlicePoint middle{};    ///< [m]
  double spread = 0.0;    ///< [m]
  double R = 0.0;         ///< [m]
  double tip = 0.0;       ///< above that of the cutter [m]
};

/// @brief Chains that do not lie deep in what others cover of a circle.
/// @param height  above the tip of the cutter; chains with a higher tip are left out
/// @param discs   gets what the discs in the middle of the others cover
/// @return places in `chains`
std::vector<std::size_t> chains_left(std::span<const NearChain> chains, double height,
                                     double r, std::vector<geometry::Arc>& discs);

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
/// @param discs  arcs that are covered anyway
ShortParts short_parts(std::span<const SlicePart> parts, double r,
                       std::vector<geometry::Arc> discs);

}  // namespace trochoid::stock
