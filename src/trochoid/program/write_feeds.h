#pragma once

#include <trochoid/program/move.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace trochoid::program {

/// A stretch of a move, and the feed that it is to have.
struct FeedPart {
  std::uint32_t move = 0;  ///< its place in `Program::moves`
  double from = 0.0;       ///< fraction of its path
  double to = 1.0;         ///< fraction of its path
  double feed = 0.0;       ///< along the path [m/s], above 0
};

/// @brief The same program with other feeds: F words change, and where a move has several
/// feeds its block is split; everything else stays as it is, byte by byte.
///
/// F is rounded down. A block is not split where it holds anything but a straight move or
/// an arc in the plane of the table, and words that are executed before it; it gets the
/// lowest feed of its parts.
/// @param text     that was read
/// @param program  that it came to
/// @param parts    ascending; those of a move cover all of it; moves that are not named
///                 keep their feed
/// @param split    false: no block is split
std::string write_feeds(std::string_view text, const Program& program,
                        std::span<const FeedPart> parts, bool split = true);

}  // namespace trochoid::program
