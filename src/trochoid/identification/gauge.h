#pragma once

#include <trochoid/identification/problem.h>

#include <vector>

namespace trochoid::identification {

/// Whether teeth can be renumbered without changing anything but names.
bool teeth_are_alike(const Problem& problem);

/// @brief Choose names: phase of the first run in [-pi/N, pi/N) when the teeth are
/// alike, else in [-pi, pi); other phases in [-pi, pi).
/// @return whether teeth were renumbered
bool apply_gauge(const Problem& problem, std::vector<double>& p);

}  // namespace trochoid::identification
