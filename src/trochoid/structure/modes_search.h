#pragma once

#include <trochoid/structure/modes_noise.h>

#include <vector>

namespace trochoid::structure {

/// A fit of all responses with the noise of each, and how well both explain them.
struct ModesTrial {
  ModesSolution solution;
  std::vector<ResponseNoise> noise;
  /// -2 ln L + p ln(2 n) of all responses, p all parameters; less is better
  double criterion = 0.0;

  [[nodiscard]] bool found() const noexcept { return !solution.model.terms.empty(); }
};

/// @brief Fit and noises in turn, each with the other's last answer, until both stand.
///
/// @eq  M-16  weights 1/sigma of M-15 in the sum of M-7, sigma at the model of the round
///            before;  cov = (J^T J)^-1 of the weighted residuals
/// @src derived: iteratively reweighted least squares
/// @param tolerance  change of a parameter in standard errors
ModesTrial settle(Responses all, const ModesModel& start, AllWeights weights,
                  double tolerance);

/// @brief The weights that follow from the noises of a trial, around its model.
AllWeights weights_of(Responses all, const ModesTrial& trial);

/// @brief The best fit with one mode more than a model (M-17).
///
/// Each start is fitted with the weights of the noise and with even ones, and the best
/// of each are settled.
/// @param before  without modes: the responses themselves are the residuals, and its
///                model says the form of the fit
ModesTrial with_one_more(Responses all, const ModesTrial& before);

}  // namespace trochoid::structure
