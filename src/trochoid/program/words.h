#pragma once

#include <trochoid/program/complaints.h>
#include <trochoid/program/move.h>

#include <string_view>
#include <vector>

namespace trochoid::program {

/// How a value is meant: as G90 and G91 say, or by AC( ) and IC( ) of Sinumerik.
enum class Sense : std::uint8_t { modal, absolute, incremental };

/// @brief One word of a block: a letter and its number, or a name of Sinumerik.
struct Word {
  char letter = 0;  ///< in upper case; 0: a name
  Sense sense = Sense::modal;
  bool point = false;      ///< the number is written with a decimal point
  bool has_value = false;  ///< a name may have none
  std::uint32_t at = 0;    ///< its first byte in the line
  std::uint32_t size = 0;  ///< bytes
  double value = 0.0;
  std::string_view name;    ///< of a name: as it is written
  std::string_view inside;  ///< what stands in its brackets or quotes
  bool brackets = false;    ///< there are some
  bool assigned = false;    ///< an = follows the name
};

/// @brief A line of the text.
struct Block {
  std::string_view text;
  std::uint32_t line = 1;
  bool deleted = false;  ///< begins with /
  static constexpr std::size_t all = static_cast<std::size_t>(-1);
  std::size_t optional_from = all;  ///< words from this one on stand behind a /
  bool mark = false;                ///< begins with %
  bool wrong = false;               ///< a problem of it is told
  std::vector<Word> words;
};

/// @brief Tell a problem at a byte of a block.
/// @param what  without the advice that goes with the kind of fault
void complain(Complaints& all, Block& block, std::size_t at, Fault fault,
              std::string what);

/// @brief As it is written.
std::string_view text_of(const Block& block, const Word& word) noexcept;

/// @brief Whether two texts are the same but for upper and lower case.
bool same_word(std::string_view a, std::string_view b) noexcept;

/// @brief Split a line into words. Comments go; what is no word is told.
/// @param block  with text and line
void split(Block& block, Dialect dialect, Complaints& complaints);

}  // namespace trochoid::program
