#pragma once

#include <trochoid/correction/before_after.h>
#include <trochoid/correction/controller_in_loop.h>
#include <trochoid/correction/shapes.h>
#include <trochoid/correction/speed_map.h>

#include <functional>
#include <optional>
#include <string>

namespace trochoid::correction {

/// @brief A cut to be corrected.
struct CorrectionProblem {
  MovingCut cut;  ///< machine and cut; with its runout, or none where it is measured
  ActuatorLimits limits;
  std::optional<ForceRecord>
      record;  ///< measured forces: law and runout are found there
  CorrectionOptions options;
  std::optional<LoopOptions> controller;  ///< is simulated as well
};

/// @brief The motion of the table that cancels runout, its command, and what the cut is
/// like before and after.
struct Correction {
  bool ok = false;
  std::string reason;  ///< when not ok: what follows is known as far as it went
  Setting setting;
  Plan plan;
  BeforeAfter cuts;
  SpeedMap speeds;
  AxisLimits axes;
  /// What an estimator on the machine begins with; none of more than eight teeth.
  std::optional<TrochoidEstimatorConfig> estimator;
  std::optional<ControllerInLoop> controller;
};

/// Told what is done next; may be empty.
using CorrectionProgress = std::function<void(const std::string& what)>;

/// @brief Find the runout, plan a correction and look at what it leaves.
/// @throws std::invalid_argument for a cutter that is no cylinder, and where RigidCut
/// and dynamics::motion do
Correction correct(const CorrectionProblem& problem,
                   const CorrectionProgress& progress = {});

}  // namespace trochoid::correction
