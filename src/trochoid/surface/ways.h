#pragma once

#include <trochoid/surface/find_runout.h>
#include <trochoid/surface/fitted_rows.h>

#include <functional>
#include <span>
#include <vector>

namespace trochoid::surface {

/// @brief A way from unknowns to what the rows should be.
struct Way {
  RowModel model;
  std::function<double(std::span<const double>)> rebase;  ///< as of JointModel
  std::function<std::vector<double>(std::span<const Reading>, std::span<const double>)>
      predict;
  std::vector<std::vector<double>> starts;
};

/// @brief By every row itself, with the runout.
/// @param rows    readings or their means
/// @param runout  where the search begins
Way joint_way(const Setting& setting, std::span<const Reading> rows,
              const ModelFits& found, const RunoutFit& runout, Feedback feedback);

/// @brief By means, the runout left out.
Way nominal_way(const Setting& setting, const ModelFits& found, Feedback feedback);

/// @brief Fit, and where the way knows the feedback at one place only, go there and fit
/// again.
RowFit settle(const RowProblem& problem, const Way& way, std::vector<double> start);

/// @brief What is settled again from either side along what is known least: the valley
/// between coefficients and form is long and its floor rough.
RowFit settle_twice(const RowProblem& problem, const Way& way, RowFit settled);

}  // namespace trochoid::surface
