#pragma once

#include <string_view>

namespace trochoid::base {

/// @brief What the program answers of a case, in the order of its help.
///
/// Program, `new`, report page and docs/formats/case.md follow this list.
enum class Command {
  simulate,
  identify,
  surface,
  calibrate,
  stability,
  modes,
  actuator,
  dynamics,
  correct,
  plan,
  program,
};

constexpr std::string_view name_of(Command command) noexcept {
  switch (command) {
    case Command::simulate:
      return "simulate";
    case Command::identify:
      return "identify";
    case Command::surface:
      return "surface";
    case Command::calibrate:
      return "calibrate";
    case Command::stability:
      return "stability";
    case Command::modes:
      return "modes";
    case Command::actuator:
      return "actuator";
    case Command::dynamics:
      return "dynamics";
    case Command::correct:
      return "correct";
    case Command::plan:
      return "plan";
    case Command::program:
      return "program";
  }
  return {};
}

/// What a command answers, for help.
constexpr std::string_view purpose_of(Command command) noexcept {
  switch (command) {
    case Command::simulate:
      return "Chip thickness, forces, torque and engagement of a case; "
             "compared with its measurements, if it has any";
    case Command::identify:
      return "Cutting coefficients and runout from measured "
             "forces, with how well each is known";
    case Command::surface:
      return "The surface location error that a cut leaves over "
             "feed and height, from the deflection of cutter and wall";
    case Command::calibrate:
      return "Cutting coefficients and runout from a measured wall, without a "
             "dynamometer";
    case Command::stability:
      return "Floquet multiplier, limit depth and stability lobe diagram: whether a "
             "small vibration grows";
    case Command::modes:
      return "Natural frequencies, modal masses, stiffnesses and damping ratios from "
             "a measured frequency response function (FRF)";
    case Command::actuator:
      return "Transfer function (gain and two poles) of an actuator from a measured "
             "step";
    case Command::dynamics:
      return "Time-domain simulation of cutter, table and actuator while they cut, "
             "with runout";
    case Command::correct:
      return "The motion of the table that makes the flutes cut alike, and the "
             "feedforward command for it";
    case Command::plan:
      return "Which cut to measure next: the one that narrows cutting coefficients and "
             "runout most; how to measure a wall, and how to cut it; which feed keeps a "
             "roughness";
    case Command::program:
      return "Forces on each tooth along a whole NC program in G code, with runout: "
             "which line loads the tool most, and the feeds that keep your limits";
  }
  return {};
}

}  // namespace trochoid::base
