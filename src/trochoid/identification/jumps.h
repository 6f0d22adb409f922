#pragma once

#include <trochoid/identification/variable_projection.h>

namespace trochoid::identification {

/// @brief Whether the edges enter so suddenly that the sum of squares jumps when one of
/// them passes a sample.
bool sum_of_squares_jumps(const Problem& problem);

/// @brief The same problem without the jumps: its runs in a band, with rows from the
/// turn. Its minimum is near.
Problem smooth_problem(const Problem& problem);

/// @brief The minimum near a start.
///
/// The phases at which an edge passes a sample are known: the sum of squares is compared
/// between them, and followed downhill from the best places, until nothing changes.
Minimum refine_between_jumps(const Problem& problem, std::vector<double> start);

}  // namespace trochoid::identification
