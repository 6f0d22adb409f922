#pragma once

#include <trochoid/files/surface_columns.h>

#include <optional>
#include <string>
#include <string_view>

/// The row of names of a measured surface, wherever it stands.
namespace trochoid::files {

/// What stands before the numbers.
struct SurfaceHead {
  std::string names;      ///< the line; the fields of `head` are parts of it
  TableHead head;         ///< with the separator of its table
  char stated = 0;        ///< the separator, where a line `sep=;` states it
  std::size_t above = 0;  ///< lines before it that hold text, comments not counted
  std::size_t first = 0;  ///< the first of them
  std::size_t last = 0;   ///< and the last
  /// The first row of numbers, where it was read to see that the names stand in the
  /// comment above it.
  std::optional<std::string> row;
};

/// @brief Split a row of names; blanks between a name and its unit do not count.
/// @param separator  ' ': blanks; 'w': two of them, or more
void split_names(std::string_view line, char separator, std::vector<Field>& fields);

/// @brief Find the row of names among the first lines and settle the separator.
///
/// @param[out] head  stays where it is: its fields are parts of it
/// @throws base::InputError where there is none, with what it lacks
void find_head(TableText& table, const SurfaceSource& source, SurfaceHead& head);

}  // namespace trochoid::files
