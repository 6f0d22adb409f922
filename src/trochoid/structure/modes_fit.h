#pragma once

#include <trochoid/structure/frequency_response.h>
#include <trochoid/structure/mode.h>

#include <array>
#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace trochoid::structure {

struct ModesOptions {
  int count = 0;  ///< modes to fit; 0: chosen
  /// Stand for the modes below and above the band; absent: chosen.
  std::optional<bool> residual_terms;
  std::optional<bool> complex_shapes;  ///< of identify_shapes; absent: chosen
  // Of identify_modes; several responses come with bands and windows of their own.
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

/// One of the fits among which number and form of the modes were chosen.
struct ModesOrder {
  std::vector<std::pair<double, double>> modes;  ///< omega [rad/s] and zeta, by omega
  std::size_t count = 0;                         ///< of those that would be answers
  bool residual_terms = false;
  double criterion = 0.0;  ///< -2 ln L + p ln(2 n): less is better
  std::string fault;       ///< why it cannot be the answer; empty: it can
  bool complex_shapes = false;
};

/// A number and its standard error.
struct Known {
  double value = 0.0;
  double se = 0.0;
};

/// One mode of a fit; its standard errors are those under the noise of the fit.
struct FittedMode {
  Known omega;      ///< natural frequency [rad/s]
  Known zeta;       ///< damping ratio
  Known mass;       ///< [kg]; with a shape 1/sum |phi|^2: of motion along it
  Known stiffness;  ///< [N/m]
  Known damping;    ///< [N s/m]
  /// Mass-normalised shape [1/sqrt(kg)], one of each direction, where several responses
  /// tell it. Its largest component is above 0 where the shape is real, and has a real
  /// part above 0 where it is complex.
  std::vector<std::complex<double>> phi;
  std::vector<std::complex<double>> phi_se;  ///< of real and imaginary part
  Known angle;      ///< of Re phi, from the first direction towards the second [rad]
  Known imaginary;  ///< |Im phi|/|phi|
  int lines_in_peak = 0;  ///< between the half-power points, where they are fewest

  [[nodiscard]] Mode mode() const noexcept {
    return {mass.value, stiffness.value, damping.value};
  }
};

/// phi_j phi_k of a mode in a response [1/kg].
struct ShapeResidue {
  std::complex<double> value;
  std::complex<double> se;  ///< of real and imaginary part
};

/// One response and the fit through it.
struct FittedResponse {
  ResponseKind kind = ResponseKind::receptance;
  std::vector<double> omega;
  std::vector<std::complex<double>> H;       ///< as measured
  std::vector<std::complex<double>> fitted;  ///< in the same kind
  double explained = 0.0;                    ///< 1 - sum |residual|^2 / sum |H|^2
  double rms = 0.0;                          ///< in the unit of H
  ResponseNoise noise;
  std::vector<ShapeResidue> residues;  ///< of each mode that has a shape
  /// U [m/N] and L [1/kg] for modes above and below.
  std::array<double, 2> residual{};
  double decay = 0.0;            ///< of an exponential window [1/s]
  double noise_bandwidth = 1.0;  ///< of the lines
};

/// Two responses that are one where the structure is symmetric: H_jk and H_kj.
struct Reciprocity {
  std::size_t one = 0;    ///< index of a response
  std::size_t other = 0;  ///< of the transposed one
  Known gain;             ///< of the other over the one; 1: they agree
};

struct ModesFit {
  bool ok = false;
  std::string reason;             ///< when not ok
  std::vector<FittedMode> modes;  ///< by frequency; empty when not ok
  bool complex_shapes = false;
  /// The same modes with real shapes: `modes` themselves unless these are complex.
  std::vector<FittedMode> real_modes;
  /// Of omega [rad/s], zeta, mass [kg] and, of several directions, angle [rad] of each of
  /// the real modes in turn: row-major; empty: not all can be told.
  std::vector<double> covariance;
  /// By how much the criterion of real shapes is above that of complex ones; absent:
  /// not both were tried with an answer.
  std::optional<double> complex_evidence;
  bool residual_terms = false;
  std::vector<FittedResponse> responses;
  std::vector<Reciprocity> reciprocity;
  std::vector<FittedMode> outside;  ///< stand for modes above and below as well
  /// Resonances that are in the fit, but too narrow for the lines or cut off by the
  /// band: their numbers are no answer.
  std::vector<FittedMode> unresolved;
  std::vector<std::string> left_out;  ///< why, one for each
  std::vector<ModesOrder> orders;     ///< all that were tried
  double criterion = 0.0;             ///< of the one chosen
  int alternative = 0;            ///< another number of modes that is likely; 0: none
  double alternative_odds = 0.0;  ///< how many times likelier the answer is
};

}  // namespace trochoid::structure
