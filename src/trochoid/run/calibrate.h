#pragma once

#include <trochoid/base/answer.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/progress.h>

namespace trochoid::run {

/// @brief Cutting coefficients, and runout where it shows, from measured walls.
/// @throws base::InputError when a measurement cannot be used
base::Answer calibrate(const inputs::Case& given, const Progress& progress);

}  // namespace trochoid::run
