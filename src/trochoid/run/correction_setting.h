#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/correction/moving_cut.h>
#include <trochoid/correction/ratio.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/shared/progress.h>

#include <optional>
#include <string>
#include <vector>

namespace trochoid::run {

/// What there is to correct, and with what.
struct CorrectionSetting {
  correction::MovingCut cut;  ///< with the runout and the law that are there
  correction::ActuatorLimits limits;
  std::vector<double> rho;           ///< runout that is there [m], mean 0
  std::vector<double> designed_for;  ///< runout that the command is made for [m]
  std::optional<correction::StaticFit> fit;  ///< of the forces
  std::optional<correction::RatioEstimate> ratio;
  std::optional<correction::TrueRunout> behind;  ///< the fit of a measurement
  double angle_offset = 0.0;  ///< true angle minus the recorded one [rad]
};

/// @brief Machine, cut and runout of a case; runout and law are found in its
/// [[measurement]] if it has one.
/// @param[out] warnings  what was found out on the way
/// @return none, with the reason in `message`, where the runout cannot be found
std::optional<CorrectionSetting> correction_setting(
    const inputs::Case& given, const Progress& progress,
    std::vector<base::Warning>& warnings, std::string& message);

}  // namespace trochoid::run
