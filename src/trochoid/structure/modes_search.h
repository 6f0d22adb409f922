#pragma once

#include <trochoid/structure/modes_noise.h>

namespace trochoid::structure {

/// A fit with its noise, and how well both explain a response.
struct ModesTrial {
  ModesSolution solution;
  ResponseNoise noise;
  double criterion = 0.0;  ///< -2 ln L + p ln(2 n), p all parameters; less is better
};

/// @brief Fit and noise in turn, each with the other's last answer, until both stand.
///
/// @eq  M-16  weights 1/sigma of M-15 in the sum of M-7, sigma at the model of the round
///            before;  cov = (J^T J)^-1 of the weighted residuals
/// @src derived: iteratively reweighted least squares
/// @param tolerance  change of a parameter in standard errors
ModesTrial settle(const FrequencyResponse& lines, const ModesModel& start,
                  LineWeights weights, double tolerance);

/// @brief The best fit with one mode more than another fit.
///
/// @eq  M-17  gain of a mode more = (g^T r)^2/(g^T g) over frequencies and dampings, r
///            the weighted residual, g what a mode there would add to it
/// @src derived: the change of the sum of squares by one linear parameter
///
/// Starts are all modes anew by M-5, those found with one more where M-17 is largest,
/// and those found with one split in two; each is fitted with the weights of the noise
/// and with even ones, and the best of each are settled.
/// @param before  without modes: the response itself is the residual
ModesTrial with_one_more(const FrequencyResponse& lines, const ModesTrial& before,
                         bool residual_terms);

}  // namespace trochoid::structure
