#pragma once

#include <trochoid/force/forces.h>

#include <span>

namespace trochoid::force {

/// @brief What a course of the force comes to, axis by axis [N].
struct ForceStatistics {
  Vector3 mean{};
  Vector3 min{};
  Vector3 max{};
  Vector3 rms{};
  double peak_xy = 0.0;  ///< largest force in the plane of the table
};

/// @param loads  at least one
ForceStatistics force_statistics(std::span<const Loads> loads);

/// What a course of torque and bending moment comes to [N m].
struct MomentStatistics {
  double mean_torque = 0.0;
  double peak_torque = 0.0;
  double peak_bending = 0.0;
};

MomentStatistics moment_statistics(std::span<const Loads> loads);

}  // namespace trochoid::force
