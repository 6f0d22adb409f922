#pragma once

#include <array>
#include <complex>
#include <optional>

namespace trochoid::structure {

/// @brief A positioning system with two poles: y + sum y' + product y'' = gain u.
///
/// Sum and product of its time constants describe it on both sides of the critical
/// damping, and stay well determined where the constants themselves do not.
struct ActuatorDynamics {
  double gain = 1.0;     ///< K_0
  double sum = 0.0;      ///< S = T_1 + T_2 = 2 zeta/omega_n [s], at least 0
  double product = 0.0;  ///< P = T_1 T_2 = 1/omega_n^2 [s^2], above 0
};

/// @brief From two first-order lags in a row.
/// @eq  M-8  G(s) = K_0/((1 + T_1 s)(1 + T_2 s)) = K_0/(1 + S s + P s^2)
/// @src [diez2010] eq. (15), signs repaired
ActuatorDynamics from_time_constants(double gain, double T1, double T2) noexcept;

/// @brief From the natural frequency and the damping ratio.
/// @param frequency  [Hz], above 0
ActuatorDynamics from_frequency(double gain, double frequency, double zeta) noexcept;

double natural_frequency(const ActuatorDynamics& actuator) noexcept;  ///< [rad/s]
double damping_ratio(const ActuatorDynamics& actuator) noexcept;

/// @brief The two real time constants, the longer one
/// first; none below the critical damping.
/// @eq  M-9  T_{1,2} = (S +- sqrt(S^2 - 4 P))/2
/// @src [diez2010] eq. (16), reconstructed
std::optional<std::array<double, 2>> time_constants(
    const ActuatorDynamics& actuator) noexcept;

/// @brief The coefficients a0, a1, a2 of a2 y'' + a1 y' + a0 y = u.
/// @eq  M-10  a_0 = 1/K_0,  a_1 = S/K_0,  a_2 = P/K_0
/// @src [diez2010] eq. (16), reconstructed
std::array<double, 3> equation_coefficients(const ActuatorDynamics& actuator) noexcept;

/// @brief Motion over command at an angular frequency (M-8).
std::complex<double> response(const ActuatorDynamics& actuator, double omega) noexcept;

/// @brief Motion a time t after a command of 1; 0 before.
/// @eq  M-11  y = K_0 (1 - C(t) - a D(t)),  a = S/(2 P), C and D those of M-2 with
///            omega_n^2 = 1/P
/// @src derived from M-8
double step_response(const ActuatorDynamics& actuator, double t) noexcept;

/// @brief Where the gain has fallen to 1/sqrt(2) of the static one [Hz].
/// @eq  M-12  (1 - P omega^2)^2 + (S omega)^2 = 2
/// @src derived from M-8
double half_power_frequency(const ActuatorDynamics& actuator) noexcept;

/// @brief Where the motion lags by an angle in (0, pi) [Hz].
/// @throws std::invalid_argument for another angle
double lag_frequency(const ActuatorDynamics& actuator, double lag);

/// @brief By how much slow commands are late: S [s].
double low_frequency_delay(const ActuatorDynamics& actuator) noexcept;

/// @brief When a step first reaches a part of its final value [s].
/// @param part  in (0, 1)
/// @throws std::invalid_argument for another part
double rise_time(const ActuatorDynamics& actuator, double part);

}  // namespace trochoid::structure
