#pragma once

#include <trochoid/base/answer.h>
#include <trochoid/dynamics/motion.h>

namespace trochoid::run {

/// motion.csv: displacements of tool and table along x and y, actuator and command.
base::Table motion_table(const dynamics::MotionProblem& p, const dynamics::Motion& m);

/// forces.csv of the same moments.
base::Table motion_forces_table(const dynamics::Motion& m);

/// once_per_turn.csv: tool minus work at the start of every turn.
base::Table once_table(const dynamics::Motion& m);

}  // namespace trochoid::run
