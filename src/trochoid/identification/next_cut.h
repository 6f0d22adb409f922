#pragma once

#include <trochoid/geometry/cut.h>
#include <trochoid/identification/plan.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Which cut to measure next: the one after which the quantities that are asked for are
/// known best (I-20, I-21).
namespace trochoid::identification {

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

/// What earlier records tell, and what the next one is expected to be.
struct Knowledge {
  Trial trial;              ///< what all cuts have in common
  Information information;  ///< of the records so far; empty: there are none
  double freedom = 0.0;     ///< of their fit: equations less unknowns
};

/// The cuts to choose from, and what they are to tell.
struct CutRequest {
  std::vector<geometry::Cut> cuts;
  /// Names without unit, such as `K_tc`; `coefficients` and `runout` stand for all of them.
  std::vector<std::string> quantities;
  std::optional<double>
      max_force;  ///< in the plane of the table [N]; nothing: no limit
};

/// What the cuts would tell.
struct CutPlan {
  std::vector<PlannedQuantity> quantities;  ///< empty: the fit looks for none of them
  std::vector<PlannedCut> cuts;             ///< the best first
  std::vector<LeftOut> left_out;
  std::size_t parameters = 0;             ///< of the determinant
  std::optional<double> log_determinant;  ///< as known so far
  double factor = 0.0;  ///< half of a 95 % interval over its standard error, afterwards
};

/// @brief What a fit knows, for the cut that is measured next with the same tool.
///
/// Its last group of records counts: the tool as it is now.
/// @param fit  of the same setup, law and runs; ok
Knowledge knowledge_of(const force::Setup& setup, const force::Law& law,
                       std::span<const Run> runs, const Fit& fit);

/// @brief Largest force in the plane of the table over a turn [N].
double peak_in_plane(const Trial& trial);

/// @brief Keys of coefficients that no further cut can tell: the channel that would tell
/// them was not measured and is not measured next, as a power shows K_tc and K_te alone.
std::vector<std::string> untold_coefficients(const Knowledge& known);

/// @brief The cuts that may be measured next, compared by what all records together would
/// then tell (I-21). Threads share the cuts; the answer does not depend on their number.
///
/// @param known    the noise of its trial above 0
/// @param request  cuts that the cutter cannot make are left out, and said
CutPlan next_cut(const Knowledge& known, const CutRequest& request);

}  // namespace trochoid::identification
