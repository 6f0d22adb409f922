#pragma once

#include <trochoid/dynamics/motion.h>
#include <trochoid/inputs/case.h>

namespace trochoid::run {

/// @brief A case of `dynamics` as the motion in time takes it.
dynamics::MotionProblem motion_problem(const inputs::Case& given);

}  // namespace trochoid::run
