#pragma once

#include <optional>
#include <string_view>

namespace trochoid::base {

/// @brief Brackets within brackets, and parts of a dotted key, that are still read.
inline constexpr int deepest_brackets = 64;
inline constexpr int most_key_parts = 32;

/// @brief Where a text begins to nest too deep.
struct TooDeep {
  int line = 1;
  int column = 1;
  std::string_view why;
};

/// @brief Does a TOML or JSON text nest deeper than anything we write?
///
/// To be asked before a parser sees it, which calls itself for every level and so ends
/// the program. Strings and comments do not count. Wrong texts may give either answer.
std::optional<TooDeep> too_deep(std::string_view text) noexcept;

}  // namespace trochoid::base
