#pragma once

#include <trochoid/inputs/surface_file.h>

/// Readings that were taken more than once.
namespace trochoid::inputs {

/// @brief Average readings of the same place, offset, height and tooth into the first of
/// them, count them, and say so in the notes.
void average_repeats(SurfaceFile& surface);

}  // namespace trochoid::inputs
