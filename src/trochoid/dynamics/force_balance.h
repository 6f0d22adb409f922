#pragma once

#include <trochoid/dynamics/cut_force.h>
#include <trochoid/dynamics/newton_step.h>

#include <array>
#include <functional>

namespace trochoid::dynamics {

/// A force at the end of a step, and how far it is from what its motion asks for.
struct ForceBalance {
  Force F{};
  double force_error = 0.0;   ///< [N]
  double motion_error = 0.0;  ///< what that displaces [m]
};

/// @brief The force F(q) of the motion q = q_0 + P F that it makes itself.
///
/// @eq T-12 r(t) = P (F(q(F_g + t d)) - F_g - t d), d the step of T-6: bisect t where
///          r(t) . r(0) changes its sign, until |r| is nothing beside the chips
/// @src derived: along d the displacement is off by a number that has one sign before
///      the force that agrees and the other behind it, whatever the slope between
/// @param response_of  force and slopes where the force at the end is F_g
/// @param compliance   P, and V where the force depends on the speed as well
/// @param F_g          guess [N]
/// @param tolerance    displacements that are nothing [m]
ForceBalance balanced_force(
    const std::function<Response(const Force& F_g)>& response_of,
    const StepCompliance& compliance, const Force& F_g, double tolerance);

}  // namespace trochoid::dynamics
