#pragma once

#include <trochoid/structure/frequency_response.h>
#include <trochoid/structure/identify_modes.h>

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
  double above = 0.0;  ///< U [m/N]
  double below = 0.0;  ///< L [1/kg]

  [[nodiscard]] std::size_t size() const noexcept {
    return 3 * terms.size() + (residual_terms ? 2 : 0);
  }
};

/// A model fitted to some lines.
struct ModesSolution {
  ModesModel model;
  bool converged = false;
  double rss = 0.0;              ///< in the unit of H, squared
  std::vector<double> variance;  ///< of the parameters; empty: not all can be told
  std::vector<double>
      covariance;  ///< row-major, in the order omega, zeta, A, ..., U, L
};

/// @brief The receptance of a model (M-6).
std::complex<double> receptance(const ModesModel& model, double omega);

/// @brief Nonlinear least squares M-7 from starts of frequency and damping.
ModesSolution fit_modes(const FrequencyResponse& lines,
                        const std::vector<ModeTerm>& starts, bool residual_terms);

/// @brief A fitted mode with its standard errors.
FittedMode fitted_mode(const ModesSolution& solution, std::size_t r);

}  // namespace trochoid::structure
