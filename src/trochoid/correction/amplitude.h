#pragma once

#include <trochoid/correction/periodic_motion.h>
#include <trochoid/correction/rigid_cut.h>
#include <trochoid/correction/shapes.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trochoid::correction {

/// What is to be equal.
enum class Target {
  peak_force,     ///< the peaks of |F_y| of the flutes
  own_force,      ///< the peaks of |F_y| of each flute alone
  chip_area,      ///< what the flutes cut in a turn
  least_squares,  ///< the chips over the whole arc of cut, as nearly as possible
};

/// The names that files use.
constexpr std::string_view name_of(Target target) noexcept {
  switch (target) {
    case Target::peak_force:
      return "peak_force";
    case Target::own_force:
      return "own_force";
    case Target::chip_area:
      return "chip_area";
    case Target::least_squares:
      return "least_squares";
  }
  return {};
}

/// What of a flute a target makes equal; least_squares: the peaks.
constexpr double Flute::*value_of(Target target) noexcept {
  switch (target) {
    case Target::own_force:
      return &Flute::own_peak_y;
    case Target::chip_area:
      return &Flute::chip_area;
    case Target::peak_force:
    case Target::least_squares:
      break;
  }
  return &Flute::peak_y;
}

/// What is known of a motion that was looked for: whether a better one exists.
enum class Optimality {
  equal,              ///< no difference is left: nothing is below none
  limit_of_one_axis,  ///< least squares, a convex problem; or all starts ended here
  local_minimum,      ///< starts ended in different places: the best of them
};

/// The names that files use.
constexpr std::string_view name_of(Optimality optimality) noexcept {
  switch (optimality) {
    case Optimality::equal:
      return "equal";
    case Optimality::limit_of_one_axis:
      return "limit_of_one_axis";
    case Optimality::local_minimum:
      return "local_minimum";
  }
  return {};
}

/// On what this rests.
struct Optimum {
  Optimality optimality = Optimality::local_minimum;
  bool proven = false;  ///< no difference left, or a convex problem
  int starts = 0;       ///< of a problem that is not convex
  int agreeing = 0;     ///< starts that ended as well as the best one
};

/// A motion made as large as its target asks.
struct Amplitude {
  bool ok = false;
  std::string reason;  ///< when not ok
  PeriodicMotion motion;
  double factor = 1.0;             ///< times the motion given
  double peak_to_peak = 0.0;       ///< [m]
  double peak_difference = 0.0;    ///< of the flutes with it
  std::vector<Flute> flutes;       ///< with it
  std::optional<Optimum> optimum;  ///< of more than two teeth
};

/// Flutes of a cut with a table motion: a rigid cut, or a simulated one.
using FlutesOf = std::function<std::vector<Flute>(const PeriodicMotion& X)>;

/// @brief The factor of a motion that makes the flutes alike, as far as one number can.
///
/// @eq R-9 two teeth: v_1 = v_2, v_j the peak of |F_y|, of its own or the chip area;
///         more: min of the sum over j of (v_j/mean(v) - 1)^2
/// @eq R-10 least squares: factor = sum of e_0 g / sum of g^2, g = e_0 - e_1 the
///          part of R-7 that the motion makes
/// @src derived
/// @param flutes  for peak_force and chip_area; empty: those of the rigid cut
Amplitude amplitude_for(Target target, const RigidCut& cut, const PeriodicMotion& X,
                        const FlutesOf& flutes = {});

}  // namespace trochoid::correction
