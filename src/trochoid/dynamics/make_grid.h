#pragma once

#include <trochoid/dynamics/engaged_grid.h>

#include <vector>

namespace trochoid::dynamics {

/// @param setup  a cylinder
/// @param steps_per_tooth  positive, of a mean pitch
/// @throws std::invalid_argument for another cutter
EngagedGrid engaged_grid(const force::Setup& setup, const GridOptions& options,
                         int steps_per_tooth);

/// @param angles  ascending, in [0, 2 pi) [rad]
BetweenNodes between_nodes(const force::Setup& setup, const GridOptions& options,
                           const EngagedGrid& nodes, std::vector<double> angles);

}  // namespace trochoid::dynamics
