#pragma once

#include <trochoid/identification/problem.h>

#include <vector>

namespace trochoid::identification {

/// @brief Runouts to start from, in the unknowns of the problem: the tool that runs
/// true, patterns of an eccentricity both ways, single teeth, alternating teeth. Of those
/// that differ in the numbers of the teeth only, one: all phases are tried.
std::vector<std::vector<double>> runout_starts(const Problem& problem);

/// @brief The runout that the setup gives, in the same unknowns.
std::vector<double> given_runout(const Problem& problem);

}  // namespace trochoid::identification
