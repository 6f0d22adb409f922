#pragma once

#include <trochoid/structure/frequency_response.h>
#include <trochoid/structure/mode.h>

#include <array>
#include <complex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace trochoid::structure {

struct ModesOptions {
  int count = 0;  ///< modes to fit; 0: chosen
  /// Stand for the modes below and above the band; absent: chosen.
  std::optional<bool> residual_terms;
  double from = 0.0;  ///< lowest line [rad/s]
  double to = 0.0;    ///< highest line [rad/s]; 0: all
  /// a of an exponential window e^{-a t} on force and response [1/s], H being that of
  /// M-22; taken out of the modes.
  double window_decay = 0.0;
};

/// The noise of a response (M-15), as standard deviations.
struct ResponseNoise {
  double floor = 0.0;      ///< the same at all lines, of real and imaginary part
  double magnitude = 0.0;  ///< as a fraction of |H|
  double phase = 0.0;      ///< [rad]
};

/// One of the fits among which the number of modes was chosen.
struct ModesOrder {
  std::vector<std::pair<double, double>> modes;  ///< omega [rad/s] and zeta, by omega
  std::size_t count = 0;                         ///< of those that would be answers
  bool residual_terms = false;
  double criterion = 0.0;  ///< -2 ln L + p ln(2 n): less is better
  std::string fault;       ///< why it cannot be the answer; empty: it can
};

/// One mode of a fit; its standard errors are those under the noise of the fit.
struct FittedMode {
  Mode mode;
  double omega = 0.0;  ///< natural frequency [rad/s]
  double zeta = 0.0;
  double omega_se = 0.0;
  double zeta_se = 0.0;
  double mass_se = 0.0;
  double stiffness_se = 0.0;
  double damping_se = 0.0;
  int lines_in_peak = 0;  ///< between the half-power points
};

struct ModesFit {
  bool ok = false;
  std::string reason;             ///< when not ok
  std::vector<FittedMode> modes;  ///< by frequency; empty when not ok
  /// Of omega [rad/s], zeta and mass [kg] of each mode in turn: row-major, shape (3 modes,
  /// 3 modes).
  std::vector<double> covariance;
  bool residual_terms = false;
  std::array<double, 2> residual{};  ///< U [m/N] and L [1/kg] for modes above and below
  std::vector<FittedMode> outside;   ///< stand for modes above and below as well
  std::vector<double> omega;         ///< of the lines fitted
  std::vector<std::complex<double>> H;       ///< as measured
  std::vector<std::complex<double>> fitted;  ///< in the same kind
  double explained = 0.0;                    ///< 1 - sum |residual|^2 / sum |H|^2
  double rms = 0.0;  ///< sqrt(mean |residual|^2), in the unit of H
  ResponseNoise noise;
  double window_decay = 0.0;       ///< of the lines fitted, as in the options [1/s]
  double noise_bandwidth = 1.0;    ///< of the lines fitted
  std::vector<ModesOrder> orders;  ///< all that were tried
  /// Resonances that are in the fit, but too narrow for the lines or cut off by the
  /// band: their numbers are no answer.
  std::vector<FittedMode> unresolved;
  std::vector<std::string> left_out;  ///< why, one for each
  int alternative = 0;            ///< another number of modes that is likely; 0: none
  double alternative_odds = 0.0;  ///< how many times likelier the answer is
};

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

}  // namespace trochoid::structure
