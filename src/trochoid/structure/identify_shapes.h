#pragma once

#include <trochoid/structure/frequency_response.h>
#include <trochoid/structure/identify_modes.h>

#include <array>
#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trochoid::structure {

/// A response of a structure in one direction to a force in another or the same.
struct DirectedResponse {
  std::size_t motion = 0;  ///< direction that was measured, from 0
  std::size_t force = 0;   ///< direction of the force
  FrequencyResponse response;
  double decay = 0.0;  ///< a of an exponential window e^{-a t} [1/s]: M-22
  std::string name;    ///< for messages, like "xy"

  [[nodiscard]] bool direct() const noexcept { return motion == force; }
};

struct ShapesOptions {
  int count = 0;                       ///< modes to fit; 0: chosen
  std::optional<bool> residual_terms;  ///< absent: chosen
  std::optional<bool> complex_shapes;  ///< absent: chosen
};

/// A number and its standard error.
struct Known {
  double value = 0.0;
  double se = 0.0;
};

/// A mode that all responses share.
struct ShapeMode {
  Known omega;      ///< [rad/s]
  Known zeta;       ///< damping ratio
  Known mass;       ///< 1/sum |phi|^2 [kg]: of motion along the shape
  Known stiffness;  ///< [N/m]
  Known damping;    ///< [N s/m]
  /// Mass-normalised shape [1/sqrt(kg)], one of each direction. Its largest component is
  /// above 0 where the shape is real, and has a real part above 0 where it is complex.
  std::vector<std::complex<double>> phi;
  std::vector<std::complex<double>> phi_se;  ///< of real and imaginary part
  Known angle;      ///< of Re phi, from the first direction towards the second [rad]
  Known imaginary;  ///< |Im phi|/|phi|
  int lines_in_peak = 0;  ///< of the response with the fewest
};

/// One of the fits among which number and form of the modes were chosen.
struct ShapesOrder {
  ModesOrder order;
  bool complex_shapes = false;
};

/// phi_j phi_k of a mode in a response [1/kg].
struct ShapeResidue {
  std::complex<double> value;
  std::complex<double> se;  ///< of real and imaginary part
};

/// One response and the fit through it.
struct FittedResponse {
  std::vector<double> omega;
  std::vector<std::complex<double>> H;       ///< as measured
  std::vector<std::complex<double>> fitted;  ///< in the same kind
  double explained = 0.0;                    ///< 1 - sum |residual|^2 / sum |H|^2
  double rms = 0.0;                          ///< in the unit of H
  ResponseNoise noise;
  std::vector<ShapeResidue> residues;  ///< of each mode
  std::array<double, 2> residual{};    ///< U [m/N] and L [1/kg]
};

/// Two responses that are one where the structure is symmetric: H_jk and H_kj.
struct Reciprocity {
  std::size_t one = 0;    ///< index of a response
  std::size_t other = 0;  ///< of the transposed one
  Known gain;             ///< of the other over the one; 1: they agree
};

struct ShapesFit {
  bool ok = false;
  std::string reason;            ///< when not ok
  std::vector<ShapeMode> modes;  ///< by frequency; empty when not ok
  bool complex_shapes = false;
  /// The same modes with real shapes: `modes` themselves unless these are complex.
  std::vector<ShapeMode> real_modes;
  /// Of omega [rad/s], zeta, mass [kg] and, of several directions, angle [rad] of each of
  /// the real modes in turn: row-major; empty: not all can be told.
  std::vector<double> covariance;
  /// By how much the criterion of real shapes is above that of complex ones; absent:
  /// not both were tried with an answer.
  std::optional<double> complex_evidence;
  bool residual_terms = false;
  std::vector<FittedResponse> responses;
  std::vector<Reciprocity> reciprocity;
  std::vector<double> outside;        ///< terms beyond the band [rad/s]
  std::vector<std::string> left_out;  ///< resonances that are no answers, and why
  std::vector<ShapesOrder> orders;    ///< all that were tried
  int alternative = 0;                ///< another number of modes that is likely
  double alternative_odds = 0.0;
};

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
ShapesFit identify_shapes(const std::vector<DirectedResponse>& all,
                          const ShapesOptions& options);

/// Whether complex modes describe a response better than the real ones found in it.
struct ComplexCheck {
  double evidence = 0.0;   ///< criterion of real modes less that of complex ones
  double omega = 0.0;      ///< of the mode whose shape is the most imaginary [rad/s]
  double imaginary = 0.0;  ///< |Im phi|/|phi| there
};

/// @brief The fit of one response once more with complex shapes, from its own modes.
/// @return none: it has terms with a negative mass outside of the band, or no answer
std::optional<ComplexCheck> complex_check(const ModesFit& fit, ResponseKind kind);

}  // namespace trochoid::structure
