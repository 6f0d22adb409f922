#pragma once

#include <trochoid/structure/modes_model.h>

#include <complex>
#include <span>
#include <vector>

namespace trochoid::structure {

/// How much each line counts: its residual is turned, and its two parts are divided by
/// their standard deviations.
struct LineWeights {
  std::vector<std::complex<double>> turn;  ///< of unit length
  std::vector<double> along;               ///< 1/standard deviation, real part
  std::vector<double> across;              ///< the same, imaginary part
};

/// Of each response.
using AllWeights = std::vector<LineWeights>;

/// A model fitted to all responses.
struct ModesSolution {
  ModesModel model;
  bool converged = false;
  double cost = 0.0;  ///< sum of the squared weighted residuals
  /// Of each response what the fit takes of each weighted residual, real and imaginary
  /// part in turn: 1 where a line determines what is fitted through it. Empty as the
  /// covariance is.
  std::vector<std::vector<double>> leverage;
  std::vector<double> covariance;  ///< row-major; empty: not all can be told

  [[nodiscard]] double variance(std::size_t parameter) const {
    return covariance[parameter * model.size() + parameter];
  }
};

/// @brief Lines of each response alike. Where there are shapes the largest |H| of each
/// counts for 1; else a standard deviation of 1 in the unit of H.
AllWeights even_weights(Responses all, ModeForm form);

/// Residues of the terms of a model in one response, and its U and L.
struct Residues {
  std::vector<std::complex<double>> Z;
  std::array<double, 2> residual{};
};

/// @brief The linear parameters of one response for the poles of a model.
Residues fit_residues(const DirectedResponse& one, const LineWeights& weights,
                      const ModesModel& model);

/// @brief Nonlinear least squares M-7 or M-31 from a start of all parameters.
///
/// Without leverage and covariance, which describe() adds.
/// @param weights  the covariance takes their standard deviations as known
ModesSolution fit_modes(Responses all, const AllWeights& weights,
                        const ModesModel& start, int iterations);

/// @brief Leverage and covariance of a solution under its weights.
void describe(Responses all, const AllWeights& weights, ModesSolution& solution);

/// @brief Sum of |H_model - H|^2 over the lines of one response, in the unit of H.
double left_over(const ModesModel& model, const DirectedResponse& one,
                 std::size_t which);

/// @brief Sum of |H|^2 over its lines.
double power(const FrequencyResponse& lines);

/// @brief What the covariance of two terms makes of a quantity of each.
/// @param g, h  derivatives of the quantities by the parameters of terms r and s
double covariance(const ModesSolution& solution, std::size_t r,
                  std::span<const double> g, std::size_t s, std::span<const double> h);

}  // namespace trochoid::structure
