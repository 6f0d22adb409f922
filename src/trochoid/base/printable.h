#pragma once

#include <string>
#include <string_view>

namespace trochoid::base {

/// @brief The text without anything that a terminal would obey.
///
/// Control characters (of ASCII, and C1 in UTF-8) but line feed and tab become `\xNN`, and so
/// do bytes that are no UTF-8.
std::string printable(std::string_view text);

/// @brief The same on one line: a line feed becomes `\n`.
std::string one_line(std::string_view text);

}  // namespace trochoid::base
