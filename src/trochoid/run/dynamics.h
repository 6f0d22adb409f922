#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/results/answer.h>
#include <trochoid/run/shared/progress.h>

namespace trochoid::run {

/// @brief Motion of cutter, table and actuator while they cut.
results::Answer dynamics(const inputs::Case& given, const Progress& progress);

}  // namespace trochoid::run
