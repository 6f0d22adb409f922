#pragma once

#include <trochoid/files/csv.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trochoid::files {

/// @brief Rows of numbers under a row of names, or under none.
///
/// Columns are separated by `;`, a tab, `,` or blanks, whichever the first row of
/// numbers shows. Lines before it that hold no numbers, and lines that begin with `#`,
/// `%`, `!` or `*`, are comments; the last of them is the row of names if it has as
/// many columns.
struct FrfTable {
  std::vector<std::string> names;         ///< empty: there is no row of names
  std::vector<std::size_t> name_columns;  ///< where they stand
  std::size_t names_line = 1;
  std::vector<std::vector<double>> rows;
  std::vector<std::size_t> lines;  ///< of the rows
};

/// @brief Read all rows; what is wrong with them goes to the problems.
FrfTable read_frf_table(const std::string& text, Problems& problems);

/// @brief What follows one of these words in a name, without what separates them; none:
/// the name does not begin with one.
std::optional<std::string> unit_after(std::string_view name,
                                      std::span<const std::string_view> words);

}  // namespace trochoid::files
