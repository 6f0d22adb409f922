#pragma once

#include <trochoid/engagement/steps.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace trochoid::engagement {

/// @brief Error of a wall that a turn leaves, over its height and along the feed.
///
/// Against the wall that the nominal radius would leave; positive: material left.
struct WallError {
  double least = 0.0;  ///< [m]
  double most = 0.0;   ///< [m]
  double mean = 0.0;   ///< [m]
};

/// Walls of a step that are there at the end of the program, seen along the feed.
struct StepWalls {
  std::optional<WallError> left;
  std::optional<WallError> right;
};

/// How the search is stopped and shown.
struct WallOptions {
  base::Stop stop;
  std::function<void(double share)> progress;  ///< may be empty
};

/// @brief Errors of the walls that stay, of steps of flat tools with a body.
///
/// The cut is that of the rigid tool; the body bends at each height under the forces of the
/// turn. What stands highest of a wall is cut by the tooth that reaches farthest.
/// @eq N-21 a wall on the left (right): an arc begins at 0 (ends at pi), and at the end of
///          the program there is stock just outside R_e at that angle
/// @eq N-22 u(z) = int G(z, zeta) f dzeta = c_0 F + c_1 M_1 + k int_z (zeta - z)^3 f dzeta,
///          c_0 + c_1 zeta = G(z, zeta) for zeta <= z, k = 1/(6 E I) of the fluted part;
///          the error is E-9 of the bent teeth, sigma u across the wall
/// @src derived from B-1
/// @param steps  rows of compute_steps, in their order
/// @return shape (steps); nothing in it where the search was stopped
std::vector<StepWalls> wall_errors(const Job& job, std::span<const Step> steps,
                                   const WallOptions& options);

}  // namespace trochoid::engagement
