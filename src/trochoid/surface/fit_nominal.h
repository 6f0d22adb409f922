#pragma once

#include <trochoid/surface/calibrate.h>

#include <functional>

namespace trochoid::surface {

/// What a model says of the nominal errors, by the coefficients.
using NominalPrediction = std::function<Prediction(std::span<const double, columns> K)>;

/// What is fitted to, and what is fixed.
struct NominalFit {
  std::span<const Nominal> nominal;
  std::span<const Datum> datum;
  std::array<double, columns> K{};  ///< start; the edge coefficients stay
};

/// @brief Coefficients and datum that bring a model nearest to the nominal errors.
///
/// Gauss-Newton with the derivative that the model gives, which may be approximate; a
/// linear model is met in one step.
Answer fit_nominal(const NominalFit& fit, const NominalPrediction& predict);

/// @brief Columns of the fit, weighted: K_tc, K_rc, then the datum.
/// @return row-major, shape (nominals, 2 + datum columns)
std::vector<double> weighted_columns(const NominalFit& fit, const Prediction& at);

}  // namespace trochoid::surface
