#pragma once

#include <trochoid/base/table.h>

#include <cstddef>
#include <string>
#include <vector>

namespace trochoid::report {

/// Cells of a table that are drawn at most; a page stays below a few megabytes.
inline constexpr std::size_t drawn_cells = 400'000;

/// @brief Rows of a table that are drawn, in order: all of them; or, of a longer table,
/// the first rows of every run (column `run`), and of the rest those that hold the
/// smallest and largest values of every column in short stretches: no peak disappears.
/// A map (columns `height_mm` and `error_mm`) is thinned height by height.
std::vector<std::size_t> drawn_rows(const base::Table& table, std::size_t cells);

/// @brief JSON text of the tables as the page draws them; numbers rounded to float.
std::string tables_json(const std::vector<base::Table>& tables);

}  // namespace trochoid::report
