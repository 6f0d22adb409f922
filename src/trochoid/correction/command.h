#pragma once

#include <trochoid/correction/periodic_motion.h>
#include <trochoid/correction/plant.h>
#include <trochoid/correction/rigid_cut.h>

#include <optional>
#include <string>
#include <string_view>

namespace trochoid::correction {

/// How the command is made from the motion.
enum class Method {
  plain,            ///< the motion itself
  lead,             ///< earlier by what the actuator is late
  inverse,          ///< each harmonic through the inverse of the plant
  inverse_in_time,  ///< a_0 x + a_1 x' + a_2 x'', of smooth motions
  learning,         ///< inverse, then improved on the table itself
};

/// The names that files use.
constexpr std::string_view name_of(Method method) noexcept {
  switch (method) {
    case Method::plain:
      return "plain";
    case Method::lead:
      return "lead";
    case Method::inverse:
      return "inverse";
    case Method::inverse_in_time:
      return "inverse_in_time";
    case Method::learning:
      return "learning";
  }
  return {};
}

/// What the actuator can do.
struct ActuatorLimits {
  double stroke_low = 0.0;               ///< [m]
  double stroke_high = 60e-6;            ///< [m]
  std::optional<double> slew;            ///< fastest command [m/s]
  double push = 2000.0;                  ///< largest force on the table [N]
  double pull = 300.0;                   ///< largest force the other way [N]
  std::optional<double> most_frequency;  ///< of a command [Hz]; absent: R-15
  int most_harmonics = 15;               ///< of a command
};

/// @brief Highest frequency that a command should hold [Hz].
///
/// @eq R-15 f = 0.27 omega_n/(2 pi) of the table, where T is 1.08
/// @src chosen: 400 Hz of a table of 1490 Hz
double most_frequency(const ActuatorLimits& limits, const Plant& plant) noexcept;

struct CommandOptions {
  double sample_time = 0.0;  ///< of a command that is held between samples [s]
  int n_max = 15;            ///< harmonics looked at; the limits may allow fewer
};

/// @brief What the actuator is told over a turn of the spindle.
struct Command {
  bool ok = false;
  std::string reason;   ///< when not ok: why there is no such command
  PeriodicMotion wave;  ///< about 0 [m]; mid-stroke is to be added
  int n_max = 0;        ///< harmonics in it; 0: all
  double lead = 0.0;    ///< [s], of the method lead
};

/// @brief The command for a motion of the table.
///
/// @eq R-12 plain: u(phi) = x(phi); lead: u(phi) = x(phi + Omega (T_1 + T_2 + T_s/2))
/// @eq R-13 inverse: U_n = X_n e^(i n Omega T_s/2)/P(i n Omega), n <= n_max; mean
///          through P(0)
/// @eq R-14 in time: u = a_0 x + a_1 Omega x' + a_2 Omega^2 x'' at phi + Omega T_s/2,
///          exact but for T; the motion must have a continuous slope
/// @src derived; [diez2010] eq. 15, 16
/// @note learning starts from the inverse; see learn().
Command command_for(const PeriodicMotion& motion, Method method, const Plant& plant,
                    double Omega, const CommandOptions& options = {});

/// A motion that the actuator can follow, by harmonics.
struct Followed {
  PeriodicMotion motion;  ///< its first n_max harmonics (R-24)
  int n_max = 1;
};

/// @brief As many harmonics as stroke, slew and the frequency allowed leave; at
/// least 1.
Followed followed(const RigidCut& cut, const PeriodicMotion& motion, const Plant& plant,
                  double Omega, const ActuatorLimits& limits);

}  // namespace trochoid::correction
