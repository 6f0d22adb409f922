#pragma once

#include <trochoid/base/stop.h>
#include <trochoid/inputs/case.h>
#include <trochoid/results/stability.h>
#include <trochoid/run/shared/progress.h>

namespace trochoid::run {

/// @brief Whether a small vibration grows at the case, and over speed and depth.
/// @param stop  the diagram ends then, with a warning of the code `time_limit`
results::StabilityResult stability(const inputs::Case& given, const Progress& progress,
                                   base::Stop stop = {});

}  // namespace trochoid::run
