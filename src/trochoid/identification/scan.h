#pragma once

#include <trochoid/identification/problem.h>
#include <trochoid/signal/axes.h>

#include <span>
#include <vector>

namespace trochoid::identification {

/// A place to start from.
struct Candidate {
  std::vector<double> p;
  double rss = 0.0;  ///< [N^2]
};

/// @brief Try runouts against all phases and readings of the channels.
///
/// The force matrix is evaluated once for each runout and run, on a uniform grid over
/// the turn onto which the record is averaged: there a phase is a shift of the grid, and
/// a reading exchanges products of axes and channels and their signs.
///
/// @eq I-12 RSS(Q, s, p) = |F|^2 - g^T G(s)^-1 g, g = sum_qc Q_cq X_qc(s); of several
///          runs, G, g and |F|^2 are the sums, each run at its own shift
/// @param problem   its runs hold the channels
/// @param runouts   to try, in the unknowns of the problem (runout_starts)
/// @param readings  channels = Q force, each a signed permutation
/// @return for each reading its candidates, the best first
std::vector<std::vector<Candidate>> scan(
    const Problem& problem, const std::vector<std::vector<double>>& runouts,
    std::span<const signal::Matrix3> readings);

/// @brief The same for runs that hold the force itself.
std::vector<Candidate> scan(const Problem& problem,
                            const std::vector<std::vector<double>>& runouts);

}  // namespace trochoid::identification
