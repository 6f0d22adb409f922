#pragma once

#include <trochoid/structure/modes_problem.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace trochoid::structure {

/// What a term is, if not an answer.
enum class TermRole {
  mode,        ///< an answer
  unresolved,  ///< too narrow for the lines, too faint, or cut off by the band
  outside,     ///< it stands for what vibrates outside of the band
  none,        ///< nothing that a fit may hold
};

struct TermVerdict {
  TermRole role = TermRole::mode;
  std::string why;  ///< it is no answer
};

/// @brief What a term of a fit is.
/// @param solution  with its covariance, if all of it can be told
TermVerdict verdict_on(Responses all, const ModesSolution& solution, std::size_t r);

/// @brief A line that is out of all proportion to all others; empty: there is none.
std::string fault_of_a_line(const FrequencyResponse& lines);

/// @brief How many terms are of a kind.
std::size_t count_of(std::span<const TermVerdict> terms, TermRole role) noexcept;

/// @brief Why the terms of a fit are no answer; empty: they may be one.
/// @param count           modes that were asked for; 0: as many as there are
/// @param residual_terms  whether they were asked for; absent: as it may be
std::string fault_of(std::span<const TermVerdict> terms, int count,
                     std::optional<bool> residual_terms, bool converged);

/// @brief Whether the highest peak turns like a response of this kind.
/// @param count      pairs of poles to look for
/// @param explained  how well these must fit for the angle of a residue to mean something
/// @return if not, what it may be instead; else empty
std::string fault_of_kind(const FrequencyResponse& lines, int count,
                          double explained = 0.8);

/// @brief The same without a fit of modes: as many poles as explain nine tenths of the
/// response, which has to be turned as a whole.
std::string fault_before_search(const FrequencyResponse& lines);

}  // namespace trochoid::structure
