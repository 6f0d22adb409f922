#pragma once

#include <trochoid/structure/modes_noise.h>
#include <trochoid/structure/shapes_model.h>

#include <span>
#include <vector>

namespace trochoid::structure {

/// A model fitted to all responses.
struct ShapesSolution {
  ShapesModel model;
  bool converged = false;
  double cost = 0.0;                          ///< sum of the squared weighted residuals
  std::vector<std::vector<double>> leverage;  ///< as ModesSolution, of each response
  std::vector<double> covariance;             ///< row-major; empty: not all can be told
};

/// The responses of one structure, and how much each line counts.
using Responses = std::span<const DirectedResponse>;
using AllWeights = std::vector<LineWeights>;

/// @brief Lines of each response alike, its largest |H| being 1.
AllWeights even_weights(Responses all);

/// @brief Nonlinear least squares M-31 from a start of all parameters.
ShapesSolution fit_shapes(Responses all, const AllWeights& weights,
                          const ShapesModel& start, int iterations);

/// @brief Leverage and covariance of a solution under its weights.
void describe(Responses all, const AllWeights& weights, ShapesSolution& solution);

}  // namespace trochoid::structure
