#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/results/stability.h>
#include <trochoid/run/shared/progress.h>

namespace trochoid::run {

/// @brief Whether a small vibration grows at the case, and over speed and depth.
results::StabilityResult stability(const inputs::Case& given, const Progress& progress);

}  // namespace trochoid::run
