#pragma once

#include <string>
#include <string_view>

/// Cells of a row of comma-separated values, texts in quotes.
namespace trochoid::results {

/// @brief Append a text in quotes, on one line; what is in quotes is no number.
void append_quoted(std::string& line, std::string_view text);

/// @brief Take the first cell off a row, up to the next comma that stands in no quotes.
/// @return the cell, with its quotes if it has some
std::string_view cut_cell(std::string_view& row) noexcept;

/// @brief The text of a cell in quotes.
std::string unquoted(std::string_view cell);

}  // namespace trochoid::results
