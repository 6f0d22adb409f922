#pragma once

#include <trochoid/files/file_ref.h>
#include <trochoid/stock/solid.h>

#include <vector>

namespace trochoid::files {

/// @brief Read the faces of a body from an STL file, text or binary; its numbers are mm.
/// @throws base::InputError  what is wrong with the file: cut off, no face, not closed
std::vector<stock::Triangle> read_stl(const FileRef& file);

}  // namespace trochoid::files
