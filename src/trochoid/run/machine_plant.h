#pragma once

#include <trochoid/correction/command.h>
#include <trochoid/correction/plant.h>
#include <trochoid/inputs/machine_tables.h>

namespace trochoid::run {

/// @brief From the command to the table: [actuator] and the first mode of the table
/// along x.
/// @throws std::invalid_argument without one of the two
correction::Plant plant_of(const inputs::MachineTables& machine);

/// @brief What [actuator] says that it can do.
correction::ActuatorLimits limits_of(const inputs::Actuator& actuator);

}  // namespace trochoid::run
