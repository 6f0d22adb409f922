#pragma once

#include <trochoid/base/estimate.h>
#include <trochoid/surface/datum.h>
#include <trochoid/surface/nominal_model.h>

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace trochoid::surface {

/// @brief Cutting coefficients that a model finds in the nominal errors.
struct CoefficientFit {
  Model model = Model::imprint;
  Feedback feedback = Feedback::none;
  bool ok = false;
  std::string message = "not fitted";  ///< when not ok, why
  Estimate K_tc;                       ///< [N/m^2]
  Estimate K_rc;                       ///< [N/m^2]
  double correlation = 0.0;            ///< of the two
  std::vector<Estimate> datum;         ///< of each set: offset, then slopes, if asked
  int rank = 0;
  double condition = 0.0;
  double noise = 0.0;             ///< standard deviation of one reading [m]
  double rms = 0.0;               ///< of the nominal residuals [m]
  std::vector<double> residual;   ///< measured minus fitted, shape (nominals) [m]
  std::vector<double> predicted;  ///< shape (nominals) [m]
  /// Where the two cannot be told apart: the direction (K_tc, K_rc) that is known.
  std::array<double, 2> known{};
  Estimate combination;  ///< known . (K_tc, K_rc) [N/m^2]
};

/// Condition of D beyond which the coefficients count as not told apart: readings of a
/// micrometre then leave them open by far more than their values.
inline constexpr double worst_condition = 1000.0;

/// What a model says of the nominal errors, by the coefficients.
using NominalPrediction = std::function<Prediction(std::span<const double, columns> K)>;

/// What is fitted to, and what is fixed.
struct NominalProblem {
  std::span<const Nominal> nominal;
  std::span<const Datum> datum;
  std::array<double, columns> K{};  ///< start; the edge coefficients stay
};

/// @brief Coefficients and datum that bring a model nearest to the nominal errors.
///
/// Gauss-Newton with the derivative that the model gives, which may be approximate; a
/// linear model is met in one step.
CoefficientFit fit_nominal(const NominalProblem& problem,
                           const NominalPrediction& predict);

/// @brief Columns of the fit, weighted: K_tc, K_rc, then the datum.
/// @return row-major, shape (nominals, 2 + datum columns)
std::vector<double> weighted_columns(const NominalProblem& problem,
                                     const Prediction& at);

}  // namespace trochoid::surface
