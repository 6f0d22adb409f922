#pragma once

#include <trochoid/results/value.h>

#include <string>
#include <string_view>

/// The text of a value as JSON, and back: the one place that knows JSON.
namespace trochoid::results {

/// @brief Indented by two blanks; a list of single values, on one line. A number is the
/// shortest text that reads back the same.
std::string json_text(const Value& value);

/// @brief A text in quotes. What is not UTF-8 is replaced by U+FFFD.
std::string json_quoted(std::string_view text);

/// @throws std::invalid_argument where the text is no JSON
Value json_value(std::string_view text);

}  // namespace trochoid::results
