#pragma once

#include <trochoid/correction/periodic_motion.h>
#include <trochoid/correction/rigid_cut.h>

#include <functional>
#include <string>
#include <vector>

namespace trochoid::correction {

/// What is to be equal.
enum class Target {
  peak_force,     ///< the peaks of |F_y| of the flutes
  chip_area,      ///< what the flutes cut in a turn
  least_squares,  ///< the chips over the whole arc of cut, as nearly as possible
};

/// A motion made as large as its target asks.
struct Amplitude {
  bool ok = false;
  std::string reason;  ///< when not ok
  PeriodicMotion motion;
  double factor = 1.0;           ///< times the motion given
  double peak_to_peak = 0.0;     ///< [m]
  double peak_difference = 0.0;  ///< of the flutes with it
  std::vector<Flute> flutes;     ///< with it
};

/// Flutes of a cut with a table motion: a rigid cut, or a simulated one.
using FlutesOf = std::function<std::vector<Flute>(const PeriodicMotion& X)>;

/// @brief The factor of a motion that makes the flutes alike.
///
/// @eq R-9 sum over j of x_j v_j = 0, v_j the peak of |F_y| or the chip area of flute j
///         with the motion times the factor, x_j the levels of R-3; for two teeth: v_1
///         = v_2
/// @eq R-10 least squares: factor = sum of e_0 g / sum of g^2, g = e_0 - e_1 the part
/// of
///         R-7 that the motion makes
/// @src derived
/// @param flutes  for peak_force and chip_area; empty: those of the rigid cut
Amplitude amplitude_for(Target target, const RigidCut& cut, const PeriodicMotion& X,
                        const FlutesOf& flutes = {});

}  // namespace trochoid::correction
