#pragma once

#include <trochoid/correction/moving_cut.h>
#include <trochoid/correction/ratio.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What there is to correct: a runout that is known, or found in measured forces.
namespace trochoid::correction {

/// What a command is made for: the runout that is there, or what a static fit of the
/// forces takes it for.
enum class RunoutEstimate { known, static_fit };

/// The names that files use.
constexpr std::string_view name_of(RunoutEstimate estimate) noexcept {
  switch (estimate) {
    case RunoutEstimate::known:
      return "known";
    case RunoutEstimate::static_fit:
      return "static_fit";
  }
  return {};
}

/// @brief A cut whose runout is known.
struct Setting {
  bool ok = false;
  std::string reason;  ///< when not ok: why there is nothing to make a command for
  MovingCut cut;       ///< with the runout and the law that are there
  ActuatorLimits limits;
  std::vector<double> rho;             ///< runout that is there [m], mean 0
  std::vector<double> designed_for;    ///< runout that the command is made for [m]
  std::optional<StaticFit> fit;        ///< what a rigid model reads from the forces
  std::optional<RatioEstimate> ratio;  ///< from the measured peaks alone
  std::optional<TrueRunout> behind;    ///< the fit of a measurement
  double angle_offset = 0.0;           ///< true angle minus the recorded one [rad]
};

/// @brief The setting of a cut with its runout and its law.
///
/// A static fit of its simulated forces tells what would be read from them, where the
/// law is a power law or the command is made for that.
Setting known_setting(const MovingCut& cut, const ActuatorLimits& limits,
                      RunoutEstimate estimate);

/// @brief The setting of a cut whose law and runout are found in measured forces, the
/// compliance taken out.
/// @param cut     its law and runout are replaced
/// @param record  on the tool; its whole turns are used
Setting measured_setting(const MovingCut& cut, const ActuatorLimits& limits,
                         const ForceRecord& record, RunoutEstimate estimate);

/// The cut that a command is designed on: rigid, with the runout it is made for.
RigidCut designed_cut(const Setting& setting);

}  // namespace trochoid::correction
