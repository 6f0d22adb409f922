#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/results/dynamics.h>
#include <trochoid/run/shared/progress.h>

namespace trochoid::run {

/// @brief Motion of cutter, table and actuator while they cut.
/// @throws base::InputError when the file of [command] cannot be read
results::MotionResult dynamics(const inputs::Case& given, const Progress& progress);

}  // namespace trochoid::run
