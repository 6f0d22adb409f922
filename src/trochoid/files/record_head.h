#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

/// Where the table of a text file begins, when other lines stand before it.
namespace trochoid::files {

struct RecordHead {
  char separator = ',';  ///< ' ': blanks, as many as there are
  std::string names;     ///< the row of names, or the numbers 1, 2, ... of columns
  std::size_t names_line = 0;  ///< from 1; of the first row of numbers: there are none
  std::string units;           ///< the row of units; empty: none
  std::size_t units_line = 0;
  std::size_t data_line = 0;  ///< of the first row of numbers

  [[nodiscard]] bool named() const noexcept { return names_line < data_line; }
};

/// @brief Find the table of a text that does not begin with a row of names: lines of an
/// instrument before it, names in a comment, blanks for separators, or no names at all.
///
/// Numbers are where two rows in a row hold as many of them; names are the nearest line
/// before with as many fields.
/// @param beginning  of the file, as much as may hold its head and two rows
/// @return none: it begins with a row of names, or nothing like a table is found
std::optional<RecordHead> find_record_head(std::string_view beginning);

}  // namespace trochoid::files
