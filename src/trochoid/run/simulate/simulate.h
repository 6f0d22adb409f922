#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/results/simulate.h>

namespace trochoid::run {

/// @brief Chip, forces, torque and engagement of a case; its measurements, if it has
/// any, are compared with the forces.
/// @throws base::InputError when a measurement cannot be read
results::SimulateResult simulate(const inputs::Case& given);

}  // namespace trochoid::run
