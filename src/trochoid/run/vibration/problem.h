#pragma once

#include <trochoid/dynamics/motion.h>
#include <trochoid/dynamics/stability.h>
#include <trochoid/inputs/case.h>

namespace trochoid::run {

/// @brief How exactly [stability] wants the linearised cut; its defaults without it.
dynamics::StabilityOptions stability_options(const inputs::Case& given);

/// @brief A case of `stability` as the room dynamics takes it.
/// @param given  with the speeds and depths of [stability] settled
dynamics::StabilityProblem stability_problem(const inputs::Case& given);

/// @brief A case of `dynamics` as the motion in time takes it.
/// @throws base::InputError when the file of [command] cannot be read
dynamics::MotionProblem motion_problem(const inputs::Case& given);

}  // namespace trochoid::run
