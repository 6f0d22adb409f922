#pragma once

#include <trochoid/identification/variable_projection.h>

namespace trochoid::identification {

/// @brief Whether the edges enter so suddenly that the sum of squares jumps when one of
/// them passes a sample.
bool sum_of_squares_jumps(const Problem& problem);

/// @brief Refine a start: sweeps of the phases,
/// then smooth steps where nothing switches.
Minimum sweep_phases(const Problem& problem, std::vector<double> start);

/// @brief The same and a pattern search, until nothing changes any more.
Minimum refine_by_sweeps(const Problem& problem, std::vector<double> start);

}  // namespace trochoid::identification
