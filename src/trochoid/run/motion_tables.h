#pragma once

#include <trochoid/base/table.h>
#include <trochoid/dynamics/motion.h>
#include <trochoid/dynamics/surface_location.h>

#include <vector>

namespace trochoid::run {

/// motion.csv: displacements of tool and table along x and y, actuator and command.
base::Table motion_table(const dynamics::MotionProblem& p, const dynamics::Motion& m);

/// forces.csv of the same moments.
base::Table motion_forces_table(const dynamics::Motion& m);

/// once_per_turn.csv: tool minus work at the start of every turn.
base::Table once_table(const dynamics::Motion& m);

/// @brief Heights at which the walls are looked at: the tip, and with a helix ten steps
/// up to the axial depth [m].
std::vector<double> wall_heights(const force::Setup& setup);

/// surface_location.csv: sigma of the wall, height, tooth and its error.
base::Table surface_location_table(const std::vector<dynamics::WallLocation>& walls);

}  // namespace trochoid::run
