#pragma once

#include <trochoid/base/units.h>
#include <trochoid/correction/command.h>
#include <trochoid/correction/rigid_cut.h>

#include <string>
#include <string_view>
#include <vector>

namespace trochoid::correction {

enum class LimitKind { stroke, slew, push, pull, resonance, speed };

/// As files spell it: of the value, with its unit.
constexpr std::string_view name_of(LimitKind kind) noexcept {
  switch (kind) {
    case LimitKind::stroke:
      return "stroke_um";
    case LimitKind::slew:
      return "slew_um_per_s";
    case LimitKind::push:
      return "push_N";
    case LimitKind::pull:
      return "pull_N";
    case LimitKind::resonance:
      return "frequency_Hz";
    case LimitKind::speed:
      return "spindle_rpm";
  }
  return {};
}

/// The unit of that name, over the one of Limit::value.
constexpr double unit_of(LimitKind kind) noexcept {
  switch (kind) {
    case LimitKind::stroke:
    case LimitKind::slew:
      return unit::um;
    case LimitKind::speed:
      return unit::rpm;
    case LimitKind::push:
    case LimitKind::pull:
    case LimitKind::resonance:
      break;
  }
  return unit::one;
}

/// @brief One limit: value and limit are in SI, a frequency in Hz, a speed in rad/s.
struct Limit {
  LimitKind kind = LimitKind::stroke;
  double value = 0.0;
  double limit = 0.0;
  double margin = 0.0;  ///< limit minus value; negative: broken
  bool known = true;    ///< false: no limit was given
  bool ok = true;
  std::string reason;  ///< in words, with numbers
};

/// The limits of a command, and where it must stand in the stroke.
struct LimitReport {
  std::vector<Limit> limits;
  double offset = 0.0;  ///< to add to the wave: its middle comes to mid-stroke [m]
  bool ok = true;       ///< all that are known
};

/// @brief Every limit of a command at a speed.
///
/// @eq R-18 F_s = m X'' + (c - c_s) X' + (k - k_s) X + F_x, the force through the
///          spring: X = R-11 of the command, F_x of the rigid cut with it
/// @src derived from T-2, T-4
/// @note Stroke: max u - min u. Slew: Omega max |u'|. Push and pull: the extremes of
///       F_s. Resonance: n_max Omega/2 pi.
LimitReport check_limits(const Command& command, const Plant& plant, double Omega,
                         const ActuatorLimits& limits, const RigidCut& cut);

/// @brief Highest spindle speed at which the inverse command of a motion's first n_max
/// harmonics stays in the stroke [rad/s].
/// @param highest  where the search ends; returned if all is well up to there [rad/s]
double stroke_speed(const PeriodicMotion& motion, const Plant& plant,
                    const ActuatorLimits& limits, int n_max, double highest);

/// @brief The spindle speed against stroke_speed().
Limit speed_limit(const Command& command, const PeriodicMotion& motion,
                  const Plant& plant, double Omega, const ActuatorLimits& limits);

}  // namespace trochoid::correction
