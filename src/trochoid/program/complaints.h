#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace trochoid::program {

/// What kind of thing a program asks for that is not done.
enum class Fault : std::uint8_t {
  compensation,      ///< of the cutter radius, by the control
  subprogram,        ///< another program, or a part of this one, is called
  variable,          ///< a value that only the control knows
  loop,              ///< the order of the blocks depends on values
  cycle,             ///< moves that the control makes up
  coordinates,       ///< a frame that the control moves
  rotary,            ///< an axis that turns
  spindle_left,      ///< M4
  order,             ///< words that do not go together, or one that is missing
  feed,              ///< none, or one that depends on more than the program
  arc,               ///< no such circle
  plane,             ///< a word of another plane
  unknown_position,  ///< a move from a place that is not known
  number,            ///< a letter without a number that is right
  comment,           ///< one without an end
  group,             ///< two words of which only one can hold
  unknown,           ///< no such word
  unused,            ///< a word that nothing in its block takes
  dialect,           ///< not G code
};

/// A place in a text, from 1; columns count characters.
struct Place {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
};

struct Problem {
  Fault fault = Fault::unknown;
  Place place = {};
  std::string text;  ///< what is wrong; advice
};

/// Something that is executed, but may be meant otherwise.
struct Remark {
  std::string_view code;
  Place place = {};
  std::string text;
};

/// @brief What is found while a text is read.
struct Complaints {
  static constexpr std::size_t most = 50;
  std::vector<Problem> problems;  ///< in the order of the text, at most `most`
  std::vector<Remark> remarks;    ///< once a code, at its first place
  bool rotary_told = false;       ///< a table that turns is told once
};

/// @brief What to do about faults of that kind; empty: nothing in general.
std::string_view advice_on(Fault fault) noexcept;

/// The column of a byte of a line, from 1: characters of UTF-8, bytes where it is none.
std::uint32_t column_of(std::string_view line, std::size_t at) noexcept;

/// @brief One more remark, unless there is one of its code.
void remark(Complaints& all, std::string_view code, Place place, std::string text);

}  // namespace trochoid::program
