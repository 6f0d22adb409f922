#pragma once

#include <trochoid/identification/next_cut.h>
#include <trochoid/results/answer.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trochoid::results {

using identification::LeftOut;
using identification::PlannedCut;
using identification::PlannedQuantity;

/// @brief What `plan` answers: cuts that may be measured next, the best first.
struct PlanResult {
  Heading heading;
  std::vector<PlannedQuantity> quantities;
  std::vector<PlannedCut> cuts;  ///< the best first
  std::vector<LeftOut> left_out;
  std::size_t looked_at = 0;
  std::size_t parameters = 0;             ///< of the determinant
  std::optional<double> log_determinant;  ///< as known so far
  double factor_before = 0.0;  ///< half of a 95 % interval over its standard error
  double factor_after = 0.0;
  double diameter = 0.0;   ///< of the cutter [m]: the radial depth of a slot
  double noise = 0.0;      ///< of a sample [N]
  std::string noise_from;  ///< `records`, `given` or `assumed`
  /// Of means of channels in place of a record: which, and the standard deviation of each
  /// [N, N m, W].
  std::vector<std::string> channels;
  std::vector<double> mean_sd;
  int turns = 0;
  int samples_per_rev = 0;
  std::vector<std::string> files;  ///< measured so far
  /// Of the records whose coefficients these are, in words; empty: there are no groups.
  std::string group;
};

/// @brief A cut in words: `up milling, radial depth 4 mm, ...`.
std::string cut_words(const geometry::Cut& cut);

/// @brief `Cut next: ...: it narrows K_tc from +- 12 % to +- 4 %.`
std::string next_cut_sentence(const PlanResult& result);

Answer answer_of(const PlanResult& result);

}  // namespace trochoid::results
