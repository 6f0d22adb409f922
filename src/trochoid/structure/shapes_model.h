#pragma once

#include <trochoid/structure/identify_shapes.h>

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

namespace trochoid::structure {

/// One term of M-30: a pole and what it moves.
struct ShapeTerm {
  double omega = 0.0;                     ///< [rad/s]
  double zeta = 0.0;                      ///< below 1
  std::vector<std::complex<double>> phi;  ///< [1/sqrt(kg)], shape (directions)
};

/// The parameters of M-30, in the order omega, zeta, Re phi, Im phi of each term, then U
/// and L of each response.
struct ShapesModel {
  std::vector<ShapeTerm> terms;
  bool complex_shapes = false;  ///< else Im phi is 0 and no parameter
  bool residual_terms = false;
  std::vector<std::array<double, 2>> residual;  ///< U [m/N], L [1/kg] of each response
  std::size_t directions = 1;

  [[nodiscard]] std::size_t term_size() const noexcept {
    return 2 + directions * (complex_shapes ? 2 : 1);
  }
  [[nodiscard]] std::size_t size() const noexcept {
    return term_size() * terms.size() + (residual_terms ? 2 * residual.size() : 0);
  }
};

/// @brief s = i omega + a of a line (M-21).
std::complex<double> laplace(const DirectedResponse& response, double omega);

/// @brief 1/(omega_r^2 + s^2 + 2 zeta_r omega_r s).
std::complex<double> unit_mode(const ShapeTerm& term, std::complex<double> s);

/// @brief What Im(phi_j phi_k) is multiplied with in M-30.
std::complex<double> quadrature(const ShapeTerm& term, std::complex<double> s);

/// @brief The lines of one response as modelled, in its kind.
std::vector<std::complex<double>> modelled(const ShapesModel& model,
                                           const DirectedResponse& response,
                                           std::size_t which);

/// @brief Its lines less the model.
std::vector<std::complex<double>> gaps(const ShapesModel& model,
                                       const DirectedResponse& response,
                                       std::size_t which);

}  // namespace trochoid::structure
