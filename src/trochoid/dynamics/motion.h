#pragma once

#include <trochoid/dynamics/motion_problem.h>

namespace trochoid::dynamics {

/// @brief How many steps a tooth period needs: 1000, and 20 in a period of the fastest
/// mode that the cut can move (by more than 1e-5 of the chip).
int steps_needed(const MotionProblem& problem);

/// More steps a tooth than this are refused.
inline constexpr int most_steps = 400000;

/// @brief Motion of cutter, table and actuator while the cut goes on.
///
/// @eq T-4 m_r q_r'' + c_r q_r' + k_r q_r = (x_r, y_r) . F(t, q(t), q(t - t_m))
/// @src [diez2010] eq. 8 to 13, each body in the axes of the workpiece
/// @eq T-6 F = F_g + (I - J P)^-1 (F(q(F_g)) - F_g), J = dF/dq, P = dq/dF: the force at
///         the end of a step
/// @src derived: a step of Newton's method
/// Second order in the step: exact for a force that is linear over a step, with the
/// forces on both sides of every entry and exit.
/// @throws std::invalid_argument where engaged_grid does, and beyond most_steps
Motion motion(const MotionProblem& problem);

}  // namespace trochoid::dynamics
