#pragma once

#include <trochoid/correction/amplitude.h>
#include <trochoid/correction/residual_map.h>
#include <trochoid/correction/shapes.h>

#include <array>
#include <numbers>
#include <span>
#include <vector>

namespace trochoid::correction {

/// Widths of a change of level among which one is chosen [rad]: 40 to 140 deg.
inline constexpr std::array<double, 6> transition_widths = {
    std::numbers::pi * 2 / 9, std::numbers::pi / 3,     std::numbers::pi * 4 / 9,
    std::numbers::pi * 5 / 9, std::numbers::pi * 2 / 3, std::numbers::pi * 7 / 9};

/// A motion of one width and so many harmonics, as large as makes the flutes alike.
struct TransitionCandidate {
  double width = 0.0;  ///< of a change of level [rad]
  int harmonics = 0;   ///< of the motion; 0: all
  PeriodicMotion motion;
  double peak_difference = 0.0;  ///< on a rigid cut whose table follows it exactly
  double area_difference = 0.0;  ///< the same, of the chip areas
};

/// What there is to choose among.
struct TransitionRange {
  Shape shape = Shape::quintic;  ///< trapezoid or quintic
  Method method = Method::inverse;
  Target target = Target::peak_force;
  int most_harmonics = 9;  ///< of commands by harmonics
};

/// @brief Every width, and for commands by harmonics (inverse, learning) every number
/// of them that changes the motion.
std::vector<TransitionCandidate> transition_candidates(const RigidCut& cut,
                                                       const TransitionRange& range);

/// @brief The candidate that leaves the flutes most alike at a speed.
///
/// @eq R-27 (w, n) = argmin A(w, n) over {D(w, n; Omega) <= min D + 0.001}: D the
///          difference of the peaks, A that of the chip areas; commands that keep
///          stroke, slew and frequency come before those that do not, and of equal ones
///          the narrowest
/// @src derived
/// @param candidates  of transition_candidates for `method`; at least one
/// @param Omega       spindle speed [rad/s]
const TransitionCandidate& chosen_transition(
    const RigidCut& cut, std::span<const TransitionCandidate> candidates, Method method,
    const MapSetting& setting, double Omega);

}  // namespace trochoid::correction
