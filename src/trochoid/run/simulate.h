#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/results/answer.h>

namespace trochoid::run {

/// @brief Chip, forces, torque and engagement of a case; its measurements, if it has
/// any, are compared with the forces.
results::Answer simulate(const inputs::Case& given);

}  // namespace trochoid::run
