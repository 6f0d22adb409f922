#pragma once

#include <trochoid/files/surface_file.h>

/// Readings that were taken more than once.
namespace trochoid::files {

/// @brief Average readings of the same place, offset, height and tooth into the first of
/// them, count them, and say so in the notes.
void average_repeats(SurfaceFile& surface);

}  // namespace trochoid::files
