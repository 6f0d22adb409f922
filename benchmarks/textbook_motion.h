#pragma once

#include <trochoid/dynamics/motion.h>

#include <vector>

namespace trochoid::benchmarks {

/// Place and speed of each mode and of the actuator at the end, and the largest force.
struct TextbookMotion {
  std::vector<double> state;
  double peak = 0.0;
};

/// @brief The same motion as a textbook has it: straight slices, Runge-Kutta of fourth
/// order with equal steps, the past read between steps on straight lines.
/// @param problem  a slot, radial chip, equal pitch, power law, modes, drive
TextbookMotion textbook_motion(const dynamics::MotionProblem& problem,
                               int steps_per_tooth, int slices);

}  // namespace trochoid::benchmarks
