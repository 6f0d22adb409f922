#pragma once

#include <trochoid/correction/amplitude.h>
#include <trochoid/correction/learning.h>
#include <trochoid/correction/limits.h>
#include <trochoid/correction/residual_map.h>
#include <trochoid/run/correction_setting.h>

#include <optional>
#include <string>
#include <vector>

namespace trochoid::run {

/// What the table is to do, and what the actuator is told.
struct CorrectionPlan {
  bool ok = false;
  std::string reason;                 ///< when not ok
  correction::PeriodicMotion motion;  ///< wanted
  correction::Command command;
  std::optional<correction::Learned> learned;
  correction::LimitReport limits;
};

/// @brief Motion and command for the runout that the setting is designed for.
///
/// A known runout: the target is met on the moving cut, actuator and all. One that was
/// read with a rigid model: on the rigid cut, as nothing else is known then.
CorrectionPlan correction_plan(const CorrectionSetting& setting,
                               const inputs::Correction& wanted);

/// @brief The same command turned off and on.
struct BeforeAfter {
  dynamics::Motion before;
  dynamics::Motion after;
};
BeforeAfter before_after(const CorrectionSetting& setting,
                         const correction::Command& command);

/// One curve of the map.
struct NamedStrategy {
  std::string name;  ///< for example `sine_lead`
  correction::Strategy strategy;
};

/// @brief Differences over spindle speed, of a rigid cut, for five strategies.
struct SpeedMap {
  std::vector<NamedStrategy> strategies;
  std::vector<double> Omega;                 ///< [rad/s]
  std::vector<correction::MapPoint> points;  ///< shape (strategies, speeds)
  std::vector<double> highest;  ///< speeds that keep the difference allowed [rad/s]
};
SpeedMap speed_map(const CorrectionSetting& setting, const CorrectionPlan& plan,
                   const inputs::Correction& wanted);

}  // namespace trochoid::run
