#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/results/surface.h>
#include <trochoid/run/shared/progress.h>

namespace trochoid::run {

/// @brief The wall that a cut leaves, with the deflection of cutter and wall.
results::SurfaceResult surface(const inputs::Case& given, const Progress& progress);

}  // namespace trochoid::run
