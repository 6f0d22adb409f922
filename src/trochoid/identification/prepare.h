#pragma once

#include <trochoid/identification/problem.h>

#include <optional>
#include <span>
#include <string>

namespace trochoid::identification {

/// A fit made ready, or why there is none.
struct Prepared {
  std::optional<Problem> problem;  ///< absent: the runs themselves cannot be used
  std::string refusal;             ///< empty: the problem can be searched
};

/// @brief What is to be found but for the phases, and its scale; without one, of 1 m.
Unknowns unknowns_of(const force::Setup& setup, const force::Law& law,
                     const Options& options);

/// @brief Fold the runs and refuse what no search can answer.
Prepared prepare(const force::Setup& setup, const force::Law& law,
                 std::span<const Run> runs, const Options& options);

/// Whether the mean forces alone cannot determine the
/// coefficients: one feed, six of them.
bool means_do_not_suffice(const Problem& problem);

}  // namespace trochoid::identification
