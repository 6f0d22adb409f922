#pragma once

#include <trochoid/base/answer.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/progress.h>

namespace trochoid::run {

/// @brief Motion of cutter, table and actuator while they cut.
base::Answer dynamics(const inputs::Case& given, const Progress& progress);

}  // namespace trochoid::run
