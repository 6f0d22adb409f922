#pragma once

#include <trochoid/structure/shapes_problem.h>

#include <vector>

namespace trochoid::structure {

/// A fit of all responses with the noise of each.
struct ShapesTrial {
  ShapesSolution solution;
  std::vector<ResponseNoise> noise;
  double criterion = 0.0;  ///< -2 ln L + p ln(2 n) of all responses; less is better
};

/// What the modes of a search may be.
struct ShapesForm {
  bool residual_terms = false;
  bool complex_shapes = false;
};

/// @brief Fit and noises in turn until both stand (M-16), for all responses together.
/// @param tolerance  change of a parameter in standard errors
ShapesTrial settle(Responses all, const ShapesModel& start, AllWeights weights,
                   double tolerance);

/// @brief The weights that follow from the noises of a trial, around its model.
AllWeights weights_of(Responses all, const ShapesTrial& trial);

/// @brief The best fit with one mode more than another fit (M-17, summed over responses).
/// @param before  without modes: the responses themselves are the residuals
ShapesTrial with_one_more(Responses all, const ShapesTrial& before, ShapesForm form,
                          std::size_t directions);

}  // namespace trochoid::structure
