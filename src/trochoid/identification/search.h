#pragma once

#include <trochoid/identification/local_minimum.h>
#include <trochoid/identification/scan.h>

#include <vector>

namespace trochoid::identification {

/// @brief The global minimum over the unknowns, as far as many starts can find it.
///
/// From a given start alone where it leads to a good fit nearby. Else scan,
/// Levenberg-Marquardt from the best few on averaged data, then on everything. Where the
/// sum of squares jumps as a function of the phase (edge forces and no lag), the last
/// part is done without derivatives.
///
/// @eq I-3 min over p of min over K of |[D(p)]{K} - {F}|^2
Minimum search(const Problem& problem);

/// @brief The same from the candidates of a scan, the best first.
Minimum search_from(const Problem& problem, const std::vector<Candidate>& candidates);

/// @brief What the averaged data make of the best candidates: enough to rank problems.
Minimum coarse_search(const Problem& problem, const std::vector<Candidate>& candidates);

/// The same fit on data averaged over the turn and with a coarse force matrix.
Problem coarse_problem(const Problem& problem);

/// @brief The local minimum near a start, as accurate as the problem allows.
Minimum settle(const Problem& problem, const std::vector<double>& start);

/// @brief Where only one component of the eccentricity shows, search that one alone.
/// @param[in,out] p  the minimum so far
void restrict_eccentricity(Problem& problem, std::vector<double>& p);

}  // namespace trochoid::identification
