#pragma once

#include <trochoid/dynamics/frequency_limit.h>
#include <trochoid/dynamics/stability.h>
#include <trochoid/results/answer.h>

#include <optional>
#include <string>
#include <string_view>
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
  bool complex_modes = false;   ///< and some of them are complex
  dynamics::System real_modes;  ///< those fitted, for other commands
  double greatest_depth = 0.0;  ///< of those looked at [m]
};

/// What verdict, limit depth, better speed and diagram come from.
enum class JudgedBy {
  modes,          ///< the Floquet multiplier
  complex_modes,  ///< the same with complex modes, which real ones do not describe
  response        ///< the measured response itself: modes do not describe it
};

/// The names that files use.
constexpr std::string_view name_of(JudgedBy by) noexcept {
  switch (by) {
    case JudgedBy::modes:
      return "modes";
    case JudgedBy::complex_modes:
      return "complex_modes";
    case JudgedBy::response:
      return "response";
  }
  return {};
}

/// @brief What `stability` answers: Floquet multiplier, limit depth and stability lobe
/// diagram.
struct StabilityResult {
  Heading heading;
  dynamics::StabilityProblem problem;  ///< what was asked
  dynamics::Stability stability;       ///< what was found
  /// Why there are no modes, and nothing was found with them; empty: there are.
  std::string no_modes = {};
  std::optional<MeasuredStability> measured = {};
  JudgedBy judged_by = JudgedBy::modes;

  [[nodiscard]] bool by_modes() const noexcept {
    return no_modes.empty() && judged_by != JudgedBy::response;
  }
};

/// @brief The limit depth of the case by what judges it [m]; nothing: all are stable.
std::optional<double> judged_limit(const StabilityResult& result);

/// @brief The verdict by what judges the case.
dynamics::StabilityVerdict judged_verdict(const StabilityResult& result);

/// @brief The limit depth over the speed by what judges the case, ascending in speed.
std::vector<dynamics::LimitPoint> judged_curve(const StabilityResult& result);

/// @brief Up to which depth was looked [m].
double judged_to(const StabilityResult& result);

/// @brief Whether the cut is stable, how deep it may be, at which speed near it deeper,
/// and how far that is to be trusted.
std::string stability_sentence(const StabilityResult& result);

Answer answer_of(const StabilityResult& result);

}  // namespace trochoid::results
