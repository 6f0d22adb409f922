#pragma once

#include <trochoid/identification/problem.h>

#include <vector>

namespace trochoid::identification {

/// A place to start from.
struct Candidate {
  std::vector<double> p;
  double rss = 0.0;  ///< [N^2]
};

/// @brief Try starts of the runout against all phases; the best first.
///
/// The force matrix is evaluated once for each runout, on a uniform grid over the turn
/// onto which the record is averaged: there a phase is a shift of the grid.
/// @param span  phases tried for the first run: from -span/2 to span/2 [rad]; 2 pi: all
std::vector<Candidate> scan(const Problem& problem, double span);

}  // namespace trochoid::identification
