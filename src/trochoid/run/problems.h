#pragma once

#include <trochoid/cases/case.h>
#include <trochoid/cases/machine_tables.h>
#include <trochoid/correction/command.h>
#include <trochoid/correction/plant.h>
#include <trochoid/dynamics/motion.h>
#include <trochoid/dynamics/stability.h>
#include <trochoid/dynamics/system.h>

#include <span>
#include <string>

/// A case as the rooms dynamics and correction take it.
namespace trochoid::run {

/// @brief The [[mode]] tables as the chip feels them; modes along z are left out.
///
/// Two of mass, stiffness and frequency give the third; a table mode moves against the
/// tool.
dynamics::System chip_modes(std::span<const cases::Mode> modes);

/// @brief From the command to the table: [actuator] and the first mode of the table
/// along x.
/// @throws std::invalid_argument without one of the two
correction::Plant plant_of(const cases::MachineTables& machine);

/// @brief What [actuator] says that it can do.
correction::ActuatorLimits limits_of(const cases::Actuator& actuator);

/// @brief Why a motion is not followed: more steps than dynamics::most_steps.
std::string too_many_steps(int steps_per_tooth);

/// @brief How exactly [stability] wants the linearised cut; its defaults without it.
dynamics::StabilityOptions stability_options(const cases::Case& given);

/// @brief A case of `stability` as the room dynamics takes it.
/// @param given  with the speeds and depths of [stability] settled
dynamics::StabilityProblem stability_problem(const cases::Case& given);

/// @brief A case of `dynamics` as the motion in time takes it.
/// @throws base::InputError when the file of [command] cannot be read
dynamics::MotionProblem motion_problem(const cases::Case& given);

}  // namespace trochoid::run
