#pragma once

#include <trochoid/structure/actuator.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace trochoid::structure {

/// A commanded step and what the actuator made of it.
struct StepRecord {
  std::vector<double> time;      ///< [s], increasing, shape (n)
  std::vector<double> position;  ///< [m], shape (n)
  double step = 0.0;             ///< of the command, not 0 [m]
  /// Between which times the command changed; absent: not known.
  std::optional<std::array<double, 2>> change;
  std::optional<double> start;  ///< known time of the step [s]; absent: fitted
};

struct ActuatorFit {
  bool ok = false;
  std::string reason;  ///< when not ok
  ActuatorDynamics dynamics;
  double gain_se = 0.0;
  double sum_se = 0.0;        ///< [s]
  double product_se = 0.0;    ///< [s^2]
  double frequency_se = 0.0;  ///< of the natural frequency [Hz]
  double damping_ratio_se = 0.0;
  double start = 0.0;     ///< of the step [s]
  double start_se = 0.0;  ///< 0: it was given
  double rest = 0.0;      ///< position before the step [m]
  std::optional<std::array<double, 2>> time_constants;  ///< [s], the longer one first
  std::array<double, 2> time_constants_se{};
  std::string time_constants_reason;  ///< why they are absent
  std::vector<double> fitted;         ///< [m], shape (n)
  double rms = 0.0;                   ///< of the residuals [m]
  double explained = 0.0;             ///< 1 - rss / sum (position - mean)^2
};

/// @brief Gain and second-order dynamics from a
/// step, on either side of the critical damping.
///
/// @eq  M-13  min over K_0, S, P, y_0 and, where it is not known, t_0 of
///            sum (y_0 + u K_0 g(t - t_0; S, P) - y)^2, g the step response M-11 for a
///            gain of 1; standard errors from s^2 (J^T J)^-1
/// @eq  M-14  T_1, T_2 are given only if S^2 - 4 P > 3 se(S^2 - 4 P)
/// @src derived from M-9: near the critical damping S and P are well determined, T_1
///      and T_2 are not; a fit that demands real poles hides an underdamped actuator
///
/// Refused: no step in the record, one that has not settled at its end, one that two
/// poles do not explain.
ActuatorFit identify_actuator(const StepRecord& record);

}  // namespace trochoid::structure
