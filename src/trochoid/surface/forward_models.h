#pragma once

#include <trochoid/surface/find_runout.h>
#include <trochoid/surface/fitted_rows.h>

#include <functional>
#include <span>
#include <vector>

namespace trochoid::surface {

/// @brief What the rows should be, by the unknowns: predictions, and where a search begins.
struct ForwardModel {
  RowModel model;
  std::function<double(std::span<const double>)> rebase;  ///< as of JointModel
  std::function<bool(std::span<const double>)> freeze;    ///< as of JointModel
  RowValues values;  ///< with the feedback as it is there; empty: slopes are exact
  std::function<std::vector<double>(std::span<const Reading>, std::span<const double>)>
      predict;
  std::vector<std::vector<double>> starts;
};

/// @brief By every row itself, with the runout.
/// @param rows    readings or their means
/// @param runout  where the search begins
ForwardModel joint_forward_model(const Setting& setting, std::span<const Reading> rows,
                                 const ModelFits& found, const RunoutFit& runout,
                                 Feedback feedback);

/// @brief By means, the runout left out.
ForwardModel nominal_forward_model(const Setting& setting, const ModelFits& found,
                                   Feedback feedback);

/// @brief Fit, and where the model knows the feedback at one place only, go there and fit
/// again.
RowFit fit_rebased(const RowProblem& problem, const ForwardModel& forward,
                   std::vector<double> start);

}  // namespace trochoid::surface
