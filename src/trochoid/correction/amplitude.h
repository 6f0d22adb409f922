#pragma once

#include <trochoid/correction/periodic_motion.h>
#include <trochoid/correction/rigid_cut.h>
#include <trochoid/correction/shapes.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace trochoid::correction {

/// What is to be equal.
enum class Target {
  peak_force,     ///< the peaks of |F_y| of the flutes
  chip_area,      ///< what the flutes cut in a turn
  least_squares,  ///< the chips over the whole arc of cut, as nearly as possible
};

/// Names of files.
constexpr std::string_view name_of(Target target) noexcept {
  switch (target) {
    case Target::peak_force:
      return "peak_force";
    case Target::chip_area:
      return "chip_area";
    case Target::least_squares:
      return "least_squares";
  }
  return {};
}

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

/// @brief The factor of a motion that makes the flutes alike, as far as one number can.
///
/// @eq R-9 two teeth: v_1 = v_2, v_j the peak of |F_y| or the chip area of flute j;
///         more: min of the sum over j of (v_j/mean(v) - 1)^2
/// @eq R-10 least squares: factor = sum of e_0 g / sum of g^2, g = e_0 - e_1 the
///          part of R-7 that the motion makes
/// @src derived
/// @param flutes  for peak_force and chip_area; empty: those of the rigid cut
Amplitude amplitude_for(Target target, const RigidCut& cut, const PeriodicMotion& X,
                        const FlutesOf& flutes = {});

/// @brief The motion of a shape that makes the flutes alike, a level for each tooth.
///
/// @eq R-26 min over the levels y_j, sum 0, of the sum over j of (v_j/mean(v) - 1)^2
/// @src derived: N - 1 levels for N - 1 differences
/// @note Two teeth, and least squares: amplitude_for. `factor` is by how much the
/// largest level grew. What is better of this and of one factor is returned.
Amplitude equal_flutes(Target target, const RigidCut& cut, Shape shape,
                       const ShapeOptions& options, const FlutesOf& flutes = {});

}  // namespace trochoid::correction
