#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/results/calibrate.h>
#include <trochoid/run/shared/progress.h>

namespace trochoid::run {

/// @brief Cutting coefficients, and runout where it shows, from measured walls.
/// @throws base::InputError when a measurement cannot be used
results::CalibrateResult calibrate(const inputs::Case& given, const Progress& progress);

}  // namespace trochoid::run
