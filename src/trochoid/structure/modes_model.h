#pragma once

#include <trochoid/structure/frequency_response.h>

#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::structure {

/// What a term has beside its pole.
enum class ModeForm {
  /// A = 1/mass of one response without a window, of either sign: M-6. A negative mass
  /// tells that a sensor points the wrong way, which no shape could.
  residue,
  real_shapes,     ///< phi of each direction: M-30 with Im phi = 0
  complex_shapes,  ///< M-30
};

/// One term of M-6 or M-30: a pole and what it moves.
struct ModeTerm {
  double omega = 0.0;  ///< [rad/s]
  double zeta = 0.0;   ///< below 1 where it has a shape
  /// [1/sqrt(kg)], shape (directions); of the form residue A [1/kg] alone
  std::vector<std::complex<double>> phi;
};

/// The parameters of M-6 or M-30, in the order omega, zeta, Re phi, Im phi of each term,
/// then U and L of each response.
struct ModesModel {
  ModeForm form = ModeForm::residue;
  bool residual_terms = false;
  std::size_t directions = 1;
  std::vector<std::array<double, 2>> residual;  ///< U [m/N], L [1/kg] of each response
  std::vector<ModeTerm> terms;

  [[nodiscard]] bool is_residue() const noexcept { return form == ModeForm::residue; }
  [[nodiscard]] bool complex_shapes() const noexcept {
    return form == ModeForm::complex_shapes;
  }
  [[nodiscard]] std::size_t term_size() const noexcept {
    return 2 + directions * (complex_shapes() ? 2 : 1);
  }
  [[nodiscard]] std::size_t size() const noexcept {
    return term_size() * terms.size() + (residual_terms ? 2 * residual.size() : 0);
  }
};

/// The responses of one structure.
using Responses = std::span<const DirectedResponse>;

/// @brief s = i omega + a of a line (M-21).
std::complex<double> laplace(const DirectedResponse& response, double omega);

/// @brief 1/(omega_r^2 + s^2 + 2 zeta_r omega_r s).
std::complex<double> unit_mode(const ModeTerm& term, std::complex<double> s);

/// @brief What Im(phi_j phi_k) is multiplied with in M-30.
std::complex<double> quadrature(const ModeTerm& term, std::complex<double> s);

/// @brief The residue of a term in a response: A, or phi_j phi_k.
std::complex<double> product(const ModesModel& model, const ModeTerm& term,
                             const DirectedResponse& response);

/// @brief f/s^2: what L is multiplied with.
std::complex<double> below(const ModesModel& model, std::complex<double> f,
                           std::complex<double> s);

/// @brief The receptance of a model at one line.
/// @param which  number of the response
std::complex<double> receptance(const ModesModel& model,
                                const DirectedResponse& response, std::size_t which,
                                std::complex<double> s);

/// @brief The lines of one response as modelled, in its kind.
std::vector<std::complex<double>> modelled(const ModesModel& model,
                                           const DirectedResponse& response,
                                           std::size_t which);

/// @brief Its lines less the model.
std::vector<std::complex<double>> gaps(const ModesModel& model,
                                       const DirectedResponse& response,
                                       std::size_t which);

}  // namespace trochoid::structure
