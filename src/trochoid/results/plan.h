#pragma once

#include <trochoid/geometry/cut.h>
#include <trochoid/results/answer.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trochoid::results {

/// A quantity that a cut is to tell.
struct PlannedQuantity {
  std::string key;           ///< as in files, for example `K_tc_MPa`
  std::string words;         ///< for a sentence, for example `K_tc`
  double unit = 1.0;         ///< of the key [SI]
  bool relative = true;      ///< told in percent; else in micrometres
  double value = 0.0;        ///< [SI]
  std::optional<double> se;  ///< as known so far [SI]; nothing: it is not
};

/// A cut that may be measured, and what it would make of the quantities.
struct PlannedCut {
  geometry::Cut cut;
  double peak_force = 0.0;       ///< in the plane of the table [N]
  std::vector<double> se;        ///< one a quantity [SI]
  double log_determinant = 0.0;  ///< of the covariance (I-21)
};

/// Cuts that were not compared, and why.
struct LeftOut {
  std::string reason;
  std::size_t count = 0;
};

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
