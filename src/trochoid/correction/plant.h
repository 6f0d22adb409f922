#pragma once

#include <trochoid/correction/periodic_motion.h>
#include <trochoid/dynamics/motion.h>
#include <trochoid/structure/actuator.h>
#include <trochoid/structure/mode.h>

#include <complex>

namespace trochoid::correction {

/// @brief From the command to the table: an actuator
/// that pushes a mode through a spring.
struct Plant {
  structure::ActuatorDynamics actuator;
  structure::Mode table;
  double k_s = 0.0;  ///< of the spring [N/m]
  double c_s = 0.0;  ///< [N s/m]
};

/// A table that is held by its actuator alone: k_s = k, c_s = c.
Plant held_by_actuator(const structure::ActuatorDynamics& actuator,
                       const structure::Mode& table) noexcept;

/// @brief Motion of the table over the command.
///
/// @eq R-11 P(i omega) = G(i omega) T(i omega),
///          T = (k_s + i c_s omega)/(k - m omega^2 + i c omega)
/// @src [diez2010] eq. 13, 15 reconstructed: T-2, T-4
std::complex<double> response(const Plant& plant, double omega) noexcept;

/// Harmonics to which the motion of a table over a turn is followed.
inline constexpr int table_harmonics = 60;

/// @brief Motion of the table that a command makes in the long run.
/// @param Omega  spindle speed [rad/s]
/// @param n_max  harmonics of a command by segments
Harmonics table_response(const Plant& plant, const PeriodicMotion& command,
                         double Omega, int n_max);

/// The actuator and its spring for dynamics::motion.
dynamics::Drive drive_of(const Plant& plant, std::size_t mode) noexcept;

}  // namespace trochoid::correction
