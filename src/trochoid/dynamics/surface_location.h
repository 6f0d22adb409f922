#pragma once

#include <trochoid/dynamics/motion.h>

#include <vector>

namespace trochoid::dynamics {

/// What the teeth leave of one finished wall at one height.
struct WallLocation {
  int sigma = 1;        ///< +1: the wall at y = -D/2 (down), -1: at y = D/2 (up)
  double height = 0.0;  ///< above the tip [m]
  std::vector<double>
      teeth;             ///< e of each tooth [m], positive where it leaves material
  double remains = 0.0;  ///< that of the tooth that reaches deepest [m]
};

/// @brief Heights at which a wall is worth looking at: the tip, and with a helix ten
/// steps up to the axial depth [m].
std::vector<double> wall_heights(const force::Setup& setup);

/// @brief Surface location error: where the wall is made, compared with a rigid tool
/// without runout.
///
/// A point of the wall is made as the edge passes it, at theta = 0 (up) or pi (down),
/// where the edge moves along the wall: what counts is where the tool stands against
/// the work at that moment, not where the force is large.
///
/// @eq T-10 e_j(z) = D/2 - R_j(z) + sigma q_y(t_j),  theta_j(z, t_j) = 0 or pi;
///          the wall keeps min_j e_j
/// @src derived; signs of docs/notation.md
///
/// @param m        at least one revolution; its last one is read
/// @param heights  above the tip [m]
/// @return for each wall that the stock has, for each height; a slot has both walls
/// @throws std::invalid_argument where the motion holds less than a revolution
/// @note The marks between the feeds, f^2/(8 R) deep, are left out, as is the motion of
///       the table along the wall.
std::vector<WallLocation> surface_location(const MotionProblem& problem,
                                           const Motion& m,
                                           const std::vector<double>& heights);

}  // namespace trochoid::dynamics
