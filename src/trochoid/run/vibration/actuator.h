#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/results/actuator.h>

namespace trochoid::run {

/// @brief Gain and dynamics of an actuator from the step of a case.
/// @param given  with [step]
/// @throws base::InputError when the file cannot be read
results::ActuatorResult actuator(const inputs::Case& given);

}  // namespace trochoid::run
