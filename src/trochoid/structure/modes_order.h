#pragma once

#include <trochoid/structure/modes_faults.h>
#include <trochoid/structure/modes_fit.h>
#include <trochoid/structure/modes_search.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace trochoid::structure {

constexpr double least_explained = 0.7;  ///< of the sum of |H|^2
/// Difference of the criterion above which evidence is very strong: odds of 150 to 1.
constexpr double very_strong = 10.0;

/// A fit and what speaks against it.
struct Candidate {
  ModesTrial trial;
  std::vector<TermVerdict> terms;
  std::string fault;  ///< empty: it may be the answer

  [[nodiscard]] bool found() const noexcept { return trial.found(); }
};

/// What the search for number and form of the modes has found.
struct OrderSearch {
  /// The best that is sound: without complex shapes, and with them.
  std::array<Candidate, 2> best;
  std::string first_fault;  ///< of the simplest fit
  std::vector<ModesOrder> orders;
};

/// @brief Lines that so many modes need in each response: three numbers a mode, two
/// residual terms, and some to tell the noise.
std::size_t lines_needed(int count) noexcept;

/// The lines of a search.
struct SearchLines {
  Responses few;   ///< thinned for the search
  Responses many;  ///< thinned for the last fit
  Responses all;   ///< as measured: they say what is resolved
};

/// @brief One mode after the other, with residual terms and without (M-16, M-17).
///
/// The search ends where some modes more have bettered nothing. Thinned lines tell less of
/// how many modes there are: orders that are near the best in them are judged in many.
void search_orders(const SearchLines& lines, const ModesOptions& options, ModeForm form,
                   OrderSearch& out);

/// @brief The last fit, until nothing moves any more.
/// @param rough  the one before, whose noises are the first weights
ModesTrial settle_exactly(Responses all, const ModesModel& start,
                          const ModesTrial& rough);

/// @brief Terms that are answers, by frequency.
std::vector<std::size_t> answers_of(const Candidate& chosen);

/// Another number of modes that is nearly as likely as the one that was chosen.
struct Alternative {
  int count = 0;  ///< 0: none
  double odds = 0.0;
};

/// @brief The likeliest other number of modes of the same form.
Alternative alternative_to(const Candidate& chosen, double criterion,
                           const std::vector<ModesOrder>& orders);

}  // namespace trochoid::structure
