#pragma once

#include <trochoid/program/words.h>
#include <trochoid/program/write_feeds.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace trochoid::program {

/// A block with one feed move.
struct MoveBlock {
  const Block& block;
  const Program& program;
  std::size_t move = 0;  ///< its place in program.moves
};

/// @brief Whether a block may be split: a line or an arc of its own, and no word that acts
/// after the move or in this block only.
bool can_split(const MoveBlock& of);

/// A part of a split block.
struct SplitPart {
  double to = 1.0;  ///< where it ends: fraction of the path
  std::string F;    ///< its F word; empty: none is needed
};

/// @brief The texts of a split block.
///
/// The first is the block as it stands, with another end and feed.
/// @param parts  ascending, the last ends at 1
/// @return shape (parts)
std::vector<std::string> split_texts(const MoveBlock& of,
                                     std::span<const SplitPart> parts);

/// @brief A block with other texts in place of some words, and words behind its last one.
/// @param texts  shape (words); empty: as it stands
std::string with_words(const Block& block, std::span<const std::string> texts,
                       std::string_view behind);

/// @brief A number with at most so many digits behind the point, without zeros at its end;
/// it always has a point.
std::string number_text(double value, int digits);

/// Digits behind the point of new places: as many as the block has, at least 3, in inches
/// 4.
int digits_of(const Block& block, bool inches) noexcept;

}  // namespace trochoid::program
