#pragma once

#include <trochoid/identification/variable_projection.h>

namespace trochoid::identification {

/// @brief The global minimum over the unknowns, as far as many starts can find it.
///
/// Scan, Levenberg-Marquardt from the best few on averaged data, then on everything.
/// Where the sum of squares jumps as a function of the phase (edge forces and no lag),
/// the last part is done without derivatives.
///
/// @eq I-3 min over p of min over K of |[D(p)]{K} - {F}|^2
Minimum search(const Problem& problem);

/// The same fit on data averaged over the turn and with a coarse force matrix.
Problem coarse_problem(const Problem& problem);

/// @brief The local minimum near a start, as accurate as the problem allows.
Minimum settle(const Problem& problem, const std::vector<double>& start);

/// Whether teeth can be renumbered without changing anything but names.
bool teeth_are_alike(const Problem& problem);

/// @brief Choose names: phase of the first run in [-pi/N, pi/N) when the teeth are
/// alike, else in [-pi, pi); other phases in [-pi, pi).
/// @return whether teeth were renumbered
bool apply_gauge(const Problem& problem, std::vector<double>& p);

}  // namespace trochoid::identification
