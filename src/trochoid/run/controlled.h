#pragma once

#include <trochoid/correction/controller.h>
#include <trochoid/run/correction_plan.h>

#include <string>
#include <vector>

namespace trochoid::run {

/// The controller at one of its steps.
struct ControllerSample {
  double time = 0.0;     ///< [s]
  double command = 0.0;  ///< [m], in the stroke
  double table = 0.0;    ///< [m]
  double gain = 1.0;
  int state = TROCHOID_DISABLED;
};

/// One turn of the spindle under the controller.
struct ControlledTurn {
  std::vector<double> peaks;  ///< of |F_y| of each flute [N]
  double difference = 0.0;    ///< (largest - smallest)/largest
  double gain = 1.0;          ///< at its end
  int state = TROCHOID_DISABLED;
};

/// @brief The moving cut with the real-time controller in the loop.
struct ControlledCut {
  bool ok = false;
  std::string reason;  ///< when not ok
  std::vector<ControlledTurn> turns;
  std::vector<ControllerSample> samples;
  int fault = TROCHOID_NO_PROBLEM;  ///< the first one
  double fault_time = 0.0;          ///< [s]
  /// From the last index pulse to rest at mid-stroke
  /// [s]; negative: it never came there.
  double time_to_safe = -1.0;
  double lowest = 0.0;   ///< command [m]
  double highest = 0.0;  ///< command [m]
  bool finite = true;    ///< false: the cut ran away
};

/// The turn in which the controller is enabled; before, it only looks.
inline constexpr int enabled_from = 6;

/// @brief Run the controller of correction/controller.h on the model of the cut.
///
/// Loop rate, encoder counts, jitter of the loop, speed ripple and a lost index pulse
/// are those of [controller]. The ripple turns the spindle unevenly in time; the
/// vibration of the cut is computed at the mean speed.
ControlledCut controlled_cut(const CorrectionSetting& setting,
                             const CorrectionPlan& plan,
                             const inputs::Controller& wanted);

}  // namespace trochoid::run
