#pragma once

#include <trochoid/files/csv_table.h>
#include <trochoid/files/surface_file.h>

#include <array>
#include <optional>
#include <vector>

/// The columns of a measured surface, by the names that measuring machines give them.
namespace trochoid::files {

struct SurfaceColumns {
  std::optional<TableColumn> x, height;                  ///< without a frame
  std::array<std::optional<TableColumn>, 3> coordinate;  ///< with one: X, Y, Z
  std::optional<TableColumn> step, feed_offset, tooth;
  std::optional<TableColumn> error, actual, nominal;
};

inline constexpr TableKind surface_kind{
    .noun = "a measured surface",
    .files = "a CSV file",
    .row = "reading",
    .example = "x_mm,height_mm,error_mm",
    .comments = "#%!",
};

/// @brief Find the columns that say where a reading lies and what it is.
SurfaceColumns find_surface_columns(const TableHead& head, const SurfaceSource& source,
                                    Problems& problems);

/// @brief Whether a row of names has all that is needed; units are not looked at.
bool names_surface(const TableHead& head, const SurfaceSource& source);

/// @brief How many columns have a name that means something here.
std::size_t known_names(const TableHead& head);

/// @brief Whether the names are those of a list with one coordinate axis a row.
bool lists_axes(const TableHead& head);

/// @brief Places in a row of all columns that are used, in ascending order.
std::vector<std::size_t> used_columns(const SurfaceColumns& columns);

}  // namespace trochoid::files
