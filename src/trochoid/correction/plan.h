#pragma once

#include <trochoid/base/units.h>
#include <trochoid/correction/amplitude.h>
#include <trochoid/correction/learning.h>
#include <trochoid/correction/limits.h>
#include <trochoid/correction/setting.h>
#include <trochoid/correction/spindle_speed.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trochoid::correction {

/// On what cut the speed map looks.
enum class MapCut { rigid, moving };

/// The names that files use.
constexpr std::string_view name_of(MapCut cut) noexcept {
  switch (cut) {
    case MapCut::rigid:
      return "rigid";
    case MapCut::moving:
      return "moving";
  }
  return {};
}

/// What a correction is to be like.
struct CorrectionOptions {
  Target target = Target::peak_force;
  Method strategy = Method::inverse;
  Shape shape = Shape::sine;
  RunoutEstimate estimate = RunoutEstimate::known;
  std::optional<double> transition;    ///< of trapezoid and quintic [rad]; absent: R-27
  int harmonics = 9;                   ///< highest of the command
  std::optional<double> peak_to_peak;  ///< of the motion wanted [m]; absent: by target
  double sample_rate = 0.0;            ///< of a held command [Hz]; 0: continuous
  double learning_gain = 0.7;
  double allowed_difference = 0.05;    ///< of the peaks, for the highest speed
  std::vector<double> spindle_speeds;  ///< of the speed map [rad/s], ascending
  MapCut map_cut = MapCut::rigid;
  std::optional<SpindleDrive>
      spindle;  ///< whose speed may change in place of the table
};

/// @brief What the table is to do, and what the actuator is told.
struct Plan {
  bool ok = false;
  std::optional<double> transition;  ///< of trapezoid and quintic [rad]
  std::string reason;                ///< when not ok
  std::optional<Optimum> optimum;    ///< of the motion, where it was looked for
  PeriodicMotion motion;             ///< wanted
  Command command;                   ///< feedforward
  std::optional<Learned> learned;
  LimitReport limits;
};

/// @brief Motion and command for the runout that a setting is designed for.
///
/// A known runout: the target is met on the moving cut, actuator and all. One that was
/// read with a rigid model: on the rigid cut, as nothing else is known then.
Plan plan_correction(const Setting& setting, const CorrectionOptions& options);

/// @brief Whether the teeth of a setting stand out alike, for the shape wanted.
bool nothing_to_correct(const Setting& setting, const CorrectionOptions& options);

/// How the command is held between samples, and how many harmonics it may have.
CommandOptions command_options(const CorrectionOptions& options);

/// @brief What the actuator is told at equally spaced spindle angles from 0, the middle
/// of the stroke added [m].
std::vector<double> command_over_turn(const Plan& plan, int points);

/// @brief The same of the motion wanted.
std::vector<double> motion_over_turn(const Plan& plan, int points);

}  // namespace trochoid::correction
