#pragma once

#include <trochoid/files/surface_file.h>

#include <istream>

/// A measured surface as text.
namespace trochoid::files {

/// @brief Read a table; as read_surface_file, without the averages.
SurfaceFile read_surface_table(std::istream& in, const SurfaceSource& source,
                               int teeth);

}  // namespace trochoid::files
