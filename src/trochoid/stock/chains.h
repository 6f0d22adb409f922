#pragma once

#include <trochoid/stock/path.h>

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace trochoid::stock {

/// @brief Pieces that follow one another and are looked at together, or a piece alone.
///
/// Together are short straight pieces at one height, of a tool that leaves an upright wall.
struct Chain {
  std::uint32_t first = 0;
  std::uint32_t last = 0;          ///< the last one of them
  bool alone = true;               ///< a piece that is none of these
  std::array<double, 2> middle{};  ///< a point of the path [m]
  double spread = 0.0;             ///< from it to the farthest point of the path [m]
  double radius = 0.0;             ///< of the tool [m]
  double z = 0.0;                  ///< of the tip [m]
  /// A later piece: when it is swept, all that these have swept is swept by others as well.
  std::uint32_t hidden_by = std::numeric_limits<std::uint32_t>::max();

  /// Whether it is hidden at the end of the path.
  [[nodiscard]] bool is_hidden() const noexcept {
    return hidden_by != std::numeric_limits<std::uint32_t>::max();
  }
};

/// @brief Chains of the pieces that are named, in their order.
///
/// In a clearing the rows lie so close that nearly all of them become hidden: what is left
/// of a thousand short blocks around a cutter are some ten chains.
/// @param pieces  ascending
/// @param radius  of the tool of a piece that leaves an upright wall; 0: it leaves another
/// @eq N-27 a chain is hidden where the arcs of discs (p_k, R_k) on the circle (p, R + spread)
///          cover all of it, |p_k - p| < R_k, z_k <= z: each such disc holds p and is convex
/// @src derived
std::vector<Chain> chains(const Path& path, const std::vector<std::uint32_t>& pieces,
                          const std::function<double(const Piece&)>& radius);

}  // namespace trochoid::stock
