#pragma once

#include <trochoid/structure/modes_fit.h>

#include <complex>
#include <optional>
#include <vector>

namespace trochoid::structure {

/// @brief Modal parameters of a measured response.
///
/// @eq  M-6  H(omega) = sum_r A_r/(omega_r^2 - omega^2 + 2 i zeta_r omega_r omega)
///           + U - L/omega^2,  m_r = 1/A_r, k_r = omega_r^2/A_r, c_r = 2 zeta_r
///           omega_r/A_r
/// @eq  M-22  H_w = f(omega) H_receptance(i omega + a): the form of M-6 with the same
///            A_r, zeta_r' omega_r' = zeta_r omega_r + a, omega_r'^2 = omega_r^2 + 2 a
///            zeta_r omega_r + a^2
/// @eq  M-7  min over omega_r, zeta_r, A_r, U, L of sum |f (H_model - H)|^2, each line
///           weighted by its noise (M-15, M-16)
/// @src derived from M-3: real modes, residual terms optional; how many by the
///      information criterion of [schwarz1978]
///
/// Modes are added one by one (M-17). A number that is not given is the one with the
/// least -2 ln L + p ln(2 n) among the fits whose modes are all resonances: inside the
/// band, below half the critical damping, with a positive mass that is known to a third.
/// Those whose half-power points are not both in the band, or with less than two lines
/// between them, stay in the fit beside better ones where the evidence for them is very
/// strong, and are not among the answers.
/// @param response  any kind; lines at 0 Hz and outside the band are left out
ModesFit identify_modes(const FrequencyResponse& response, const ModesOptions& options);

/// @brief The model M-6 of a fit at an angular frequency, as a receptance.
std::complex<double> modelled(const ModesFit& fit, double omega);

/// @brief Modes that several responses of one structure share.
///
/// @eq  M-30  H_jk(s) = sum_r (Re Z + Im Z (s + zeta_r omega_r)/omega_dr) / (omega_r^2 +
///            s^2 + 2 zeta_r omega_r s) + U_jk + L_jk/s^2,  Z = phi_jr phi_kr,
///            s = i omega + a_jk,  omega_dr = omega_r sqrt(1 - zeta_r^2)
/// @eq  M-31  min over omega_r, zeta_r, phi_r, U_jk, L_jk of the sum over responses and
///            lines of |f (H_model - H)|^2, each line weighted by the noise of its
///            response (M-15);  -2 ln L adds up over responses, the choice is by
///            -2 ln L + p ln(2 n), n lines of all
/// @src derived: poles of a linear structure are global, its residues have rank one and
///      are symmetric; Im Z = 0 where damping is proportional
///
/// Complex shapes are chosen where the criterion of the best of them is less by 10 than
/// that of the best real ones. Frequencies of lines may differ between responses, and so
/// may kinds.
/// @param all  with a direct response of one direction at least, and all directions
///             joined by cross responses
ModesFit identify_shapes(const std::vector<DirectedResponse>& all,
                         const ModesOptions& options);

/// Whether complex modes describe a response better than the real ones found in it.
struct ComplexCheck {
  ModesFit fit;            ///< with complex shapes
  double evidence = 0.0;   ///< criterion of real modes less that of complex ones
  double omega = 0.0;      ///< of the mode whose shape is the most imaginary [rad/s]
  double imaginary = 0.0;  ///< |Im phi|/|phi| there

  /// Whether the modes are complex: the evidence is very strong, odds of 150 to 1, and a
  /// shape is imaginary by more than a hundredth.
  [[nodiscard]] bool complex() const noexcept {
    return evidence > 10 && imaginary > 0.01;
  }
};

/// @brief The response of a fit once more with complex shapes, their number chosen anew:
/// real modes stand for a turned one by several, one with a negative mass among them.
/// Where each mode stands for itself, and the same modes turned are no better, that is
/// not looked for.
/// @return none: there are no complex ones
std::optional<ComplexCheck> complex_check(const ModesFit& fit);

}  // namespace trochoid::structure
