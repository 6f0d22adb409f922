#pragma once

#include <trochoid/dynamics/frequency_limit.h>
#include <trochoid/dynamics/stability.h>
#include <trochoid/results/answer.h>

#include <optional>
#include <string>
#include <vector>

namespace trochoid::results {

/// The limit depth by one solution in the frequency domain.
struct ByFrequency {
  std::optional<dynamics::FrequencyLimit> limit;  ///< of the case; none: all are stable
  std::vector<dynamics::FrequencyLimit> curve;    ///< ascending in speed
};

/// What the measured response of the tool point says by itself.
struct MeasuredStability {
  dynamics::Band band;
  ByFrequency zeroth_order;
  ByFrequency multi_frequency;
  int harmonics = 0;            ///< of the second, on each side
  bool modes_fitted = false;    ///< the modes of the multiplier come from the response
  double greatest_depth = 0.0;  ///< of those looked at [m]
};

/// @brief What `stability` answers: Floquet multiplier, limit depth and stability lobe
/// diagram.
struct StabilityResult {
  Heading heading;
  dynamics::StabilityProblem problem;  ///< what was asked
  dynamics::Stability stability;       ///< what was found
  /// Why there are no modes, and nothing was found with them; empty: there are.
  std::string no_modes = {};
  std::optional<MeasuredStability> measured = {};
};

/// @brief Whether the cut is stable, how deep it may be, at which speed near it deeper,
/// and how far that is to be trusted.
std::string stability_sentence(const StabilityResult& result);

Answer answer_of(const StabilityResult& result);

}  // namespace trochoid::results
