#pragma once

#include <trochoid/structure/frequency_response.h>
#include <trochoid/structure/identify_modes.h>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace trochoid::structure {

/// One term of M-6.
struct ModeTerm {
  double omega = 0.0;  ///< [rad/s]
  double zeta = 0.0;
  double A = 0.0;  ///< 1/mass [1/kg]
};

/// The parameters of M-6.
struct ModesModel {
  std::vector<ModeTerm> terms;
  bool residual_terms = false;
  std::array<double, 2> residual{};  ///< U [m/N], L [1/kg]

  [[nodiscard]] std::size_t residual_size() const noexcept {
    return residual_terms ? 2 : 0;
  }
  [[nodiscard]] std::size_t size() const noexcept {
    return 3 * terms.size() + residual_size();
  }
};

/// How much each line counts: its residual is turned, and its two parts are divided by
/// their standard deviations.
struct LineWeights {
  std::vector<std::complex<double>> turn;  ///< of unit length
  std::vector<double> along;               ///< 1/standard deviation, real part
  std::vector<double> across;              ///< the same, imaginary part
};

/// @brief All lines alike: standard deviations of 1 in the unit of H.
LineWeights even_weights(std::size_t lines);

/// A model fitted to some lines.
struct ModesSolution {
  ModesModel model;
  bool converged = false;
  double rss = 0.0;   ///< in the unit of H, squared
  double cost = 0.0;  ///< sum of the squared weighted residuals
  /// What the fit takes of each weighted residual, real and imaginary part in turn: 1
  /// where a line determines what is fitted through it. Empty as variance is.
  std::vector<double> leverage;
  std::vector<double> variance;  ///< of the parameters; empty: not all can be told
  std::vector<double>
      covariance;  ///< row-major, in the order omega, zeta, A, ..., U, L
};

/// @brief The receptance of a model (M-6).
std::complex<double> receptance(const ModesModel& model, double omega);

/// @brief A response less a model, line by line, in its unit.
std::vector<std::complex<double>> gaps(const FrequencyResponse& lines,
                                       const ModesModel& model);

/// @brief The linear parameters A, U, L for given frequencies and dampings.
void fit_linear(const FrequencyResponse& lines, const LineWeights& weights,
                ModesModel& model);

/// @brief Nonlinear least squares M-7 from a start of all parameters.
///
/// Without leverage and covariance, which describe() adds.
/// @param weights  the covariance takes their standard deviations as known
ModesSolution fit_modes(const FrequencyResponse& lines, const LineWeights& weights,
                        ModesModel start, int iterations);

/// @brief Leverage and covariance of a solution under its weights.
void describe(const FrequencyResponse& lines, const LineWeights& weights,
              ModesSolution& solution);

/// @brief A fitted mode with its standard errors, an exponential window taken out (M-22).
/// @param window_decay  [1/s]; may be more than the mode decays by: then its damping is
///                      not positive
FittedMode fitted_mode(const ModesSolution& solution, std::size_t r,
                       double window_decay);

/// @brief Covariance of natural frequency [rad/s], damping ratio and mass [kg] of some
/// terms, as fitted_mode gives them, those of one term behind those of another.
/// @return row-major, shape (3 terms, 3 terms); empty as that of the solution
std::vector<double> mode_covariance(const ModesSolution& solution,
                                    std::span<const std::size_t> terms,
                                    double window_decay);

}  // namespace trochoid::structure
