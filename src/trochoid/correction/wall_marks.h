#pragma once

#include <trochoid/correction/periodic_motion.h>
#include <trochoid/correction/rigid_cut.h>

#include <vector>

namespace trochoid::correction {

/// @brief The marks of the teeth on the wall beside the cutter.
struct WallMarks {
  std::vector<double> x;      ///< along the feed, over one feed per turn [m]
  std::vector<double> depth;  ///< of the wall, from the radius of the nominal tooth [m]
  double peak_to_valley = 0.0;  ///< [m]
  std::vector<double> share;    ///< of the wall that each tooth leaves, sum 1
};

/// @brief What a motion of the table along the feed does to the wall.
///
/// @eq R-25 y(x) = max over j, k of [rho_j - (x - x_jk)^2/(2 R)],
///          x_jk = f (k + (psi_j + theta_w)/2 pi) - X(psi_j + theta_w),
///          theta_w = 0 or pi
/// @src derived: each tooth leaves a circle where it passes the wall
/// @param exit  the wall that the teeth pass last (theta_w = pi), else the first one
/// @note Good to f/R. A motion along the wall moves the marks, not their depth: the
///       longest tooth makes the wall, with a correction or without.
WallMarks wall_marks(const RigidCut& cut, const PeriodicMotion& X, bool exit);

}  // namespace trochoid::correction
