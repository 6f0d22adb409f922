#pragma once

#include <trochoid/program/move.h>

#include <optional>
#include <string_view>

namespace trochoid::program {

/// @brief What has to be known of a text before its first block is executed.
struct Outline {
  Dialect dialect = Dialect::iso;
  bool changes_tool = false;  ///< M6 is somewhere in it
  /// Where `BEGIN PGM` stands, which begins a program in Heidenhain's own language.
  std::optional<std::size_t> heidenhain;
};

/// @brief Tell the dialect of a text, and look for M6.
///
/// Sinumerik: CR= IC( AC( MSG( SUPA G500 G710 %_N_, or a file .mpf .spf. LinuxCNC: O< #<
/// O1 sub, G90.1 and its like, G64 P, or a file .ngc. Comments do not count.
/// @param given  by the case; none: as the text shows
/// @param name   of the file
Outline outline_of(std::string_view text, std::optional<Dialect> given,
                   std::string_view name);

/// @brief The line that begins at a byte: without its end.
/// @return  the line, and where the next one begins; past the text: `npos`
std::pair<std::string_view, std::size_t> line_at(std::string_view text, std::size_t at);

}  // namespace trochoid::program
