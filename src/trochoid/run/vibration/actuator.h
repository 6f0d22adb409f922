#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/inputs/step_file.h>
#include <trochoid/results/actuator.h>

namespace trochoid::run {

/// @brief Which step [step] means.
inputs::StepSource step_source(const inputs::StepTables& step);

/// @brief Gain and dynamics of an actuator from the step of a case.
/// @param given  with [step]
/// @throws base::InputError when the file cannot be read
results::ActuatorResult actuator(const inputs::Case& given);

}  // namespace trochoid::run
