#pragma once

#include <trochoid/dynamics/stability.h>
#include <trochoid/results/answer.h>

namespace trochoid::results {

/// @brief What `stability` answers: Floquet multiplier, limit depth and stability lobe
/// diagram.
struct StabilityResult {
  Heading heading;
  dynamics::StabilityProblem problem;  ///< what was asked
  dynamics::Stability stability;       ///< what was found
};

Answer answer_of(const StabilityResult& result);

}  // namespace trochoid::results
