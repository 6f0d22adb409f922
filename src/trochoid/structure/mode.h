#pragma once

#include <complex>
#include <optional>
#include <string_view>

namespace trochoid::structure {

/// What a mode moves.
enum class ModeBody { tool, table };

/// As files spell it.
constexpr std::string_view name_of(ModeBody body) noexcept {
  switch (body) {
    case ModeBody::tool:
      return "tool";
    case ModeBody::table:
      return "table";
  }
  return {};
}

/// In which direction of the machine.
enum class Axis { x, y, z };

/// As files spell it.
constexpr std::string_view name_of(Axis axis) noexcept {
  switch (axis) {
    case Axis::x:
      return "x";
    case Axis::y:
      return "y";
    case Axis::z:
      return "z";
  }
  return {};
}

/// One degree of freedom: mass x'' + damping x' + stiffness x = force.
struct Mode {
  double mass = 0.0;       ///< [kg], above 0
  double stiffness = 0.0;  ///< [N/m], above 0
  double damping = 0.0;    ///< [N s/m], at least 0
};

/// What may be known of a mode: two of mass, stiffness and frequency, one damping.
struct ModeGiven {
  std::optional<double> mass;           ///< [kg]
  std::optional<double> stiffness;      ///< [N/m]
  std::optional<double> damping;        ///< [N s/m]
  std::optional<double> frequency;      ///< undamped [Hz]
  std::optional<double> damping_ratio;  ///< part of the critical damping
};

/// Position and velocity.
struct Motion {
  double x = 0.0;  ///< [m]
  double v = 0.0;  ///< [m/s]
};

/// @brief Undamped natural angular frequency [rad/s].
/// @eq  M-1  omega_n = sqrt(k/m),  zeta = c/(2 sqrt(k m)),  omega_d = omega_n
///           sqrt(1-zeta^2)
/// @src [diez2010] eq. (8) to (10), reconstructed
double natural_frequency(const Mode& mode) noexcept;

/// @brief Damping as a part of the critical one (M-1).
double damping_ratio(const Mode& mode) noexcept;

/// @brief The whole mode from what is known of it.
///
/// @throws std::invalid_argument unless two of mass, stiffness and frequency and one of
///         the dampings are given, all in their ranges
Mode completed(const ModeGiven& given);

/// @brief Motion without force, from the state at t = 0; any damping.
/// @eq  M-2  x = e^{-a t} (x0 C(t) + (v0 + a x0) D(t)),  a = zeta omega_n,
///           C = cos(omega_d t), D = sin(omega_d t)/omega_d; cosh and sinh above the
///           critical damping
/// @src derived from M-1
/// @param t  [s], at least 0
Motion free_vibration(const Mode& mode, Motion start, double t) noexcept;

/// @brief Displacement for a force of 1 N at the angular frequency omega [m/N].
/// @eq  M-3  H(omega) = 1/(k - m omega^2 + i c omega)
/// @src [diez2010] eq. (11), reconstructed
std::complex<double> receptance(const Mode& mode, double omega) noexcept;

}  // namespace trochoid::structure
