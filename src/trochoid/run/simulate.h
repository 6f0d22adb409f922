#pragma once

#include <trochoid/base/answer.h>
#include <trochoid/inputs/case.h>

namespace trochoid::run {

/// @brief Chip, forces, torque and engagement of a case; its measurements, if it has
/// any, are compared with the forces.
base::Answer simulate(const inputs::Case& given);

}  // namespace trochoid::run
