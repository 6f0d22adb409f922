#pragma once

#include <trochoid/identification/problem.h>

#include <vector>

namespace trochoid::identification {

/// @brief Runouts to start from, in the unknowns of the problem: the tool that runs
/// true, patterns of an eccentricity both ways, single teeth, alternating teeth.
std::vector<std::vector<double>> runout_starts(const Problem& problem);

}  // namespace trochoid::identification
