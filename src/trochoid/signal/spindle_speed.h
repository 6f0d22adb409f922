#pragma once

#include <trochoid/signal/record.h>

#include <span>
#include <string>
#include <vector>

namespace trochoid::signal {

/// Where to look for the spindle speed.
struct SpeedSearch {
  double Omega = 0.0;   ///< stated speed, the centre of the search [rad/s]
  double range = 0.05;  ///< searched to either side, relative to Omega; below 0.5
  int teeth = 1;
};

/// Spindle speed found in a record; not ok: the reason, and no number.
struct SpeedEstimate {
  bool ok = false;
  std::string message;     ///< when not ok, why
  double Omega = 0.0;      ///< [rad/s]
  double se = 0.0;         ///< standard error [rad/s]
  double explained = 0.0;  ///< part of the variance in the harmonics used, 0 to 1
};

/// @brief Spindle speed from the periodicity of the forces alone.
///
/// Fits the harmonics k Omega t of the spindle (k = 1..4, the first three multiples of
/// the number of teeth, and up to 12 for few teeth) to all three channels at once and
/// takes the speed that explains most, which is the maximum of the likelihood in white
/// noise. A coarse search over part of the record, then over ever longer parts, leads
/// to the Gauss-Newton steps that end it. Equal teeth without runout have harmonics of
/// the tooth passing only; the search around the stated speed keeps them apart.
///
/// @eq  S-1  Omega = argmax of sum_c |P(Omega) F_c|^2, P projecting on the
///           e^(i k Omega t)
///
/// The standard error comes from how much 20 parts of the record disagree, so that a
/// speed that wanders is allowed for; never below that of white noise.
/// @param record  with `time`; at least two revolutions of the stated speed
/// @throws std::invalid_argument when Omega, range or teeth are out of range
SpeedEstimate spindle_speed(const Record& record, const SpeedSearch& search);

/// @brief Angle of the spindle at each sample, 0 at the first: Omega (t - t_0).
/// @return [rad], shape (n)
std::vector<double> angle_from_time(std::span<const double> time, double Omega);

}  // namespace trochoid::signal
