#pragma once

#include <trochoid/structure/modes_problem.h>

#include <string>

namespace trochoid::structure {

/// @brief Lines between the half-power points of a term.
int lines_in_peak(const FrequencyResponse& lines, const ModeTerm& term);

/// What speaks against a term.
struct ModeFault {
  std::string why;  ///< empty: nothing
  /// It is a resonance, but too narrow for the lines or cut off by the band: it belongs
  /// into the fit, and not into the answer.
  bool unresolved = false;
};

/// @brief Why a term is no resonance of a record, or cannot be told.
/// @param solution  with its covariance, if all of it can be told
ModeFault fault_of(const FrequencyResponse& lines, const ModesSolution& solution,
                   std::size_t r);

/// @brief Whether the highest peak turns like a response of this kind.
/// @param count  pairs of poles to look for
/// @return if not, what it may be instead; else empty
std::string fault_of_kind(const FrequencyResponse& lines, int count);

}  // namespace trochoid::structure
