#pragma once

#include <trochoid/base/units.h>

#include <array>
#include <optional>
#include <string_view>
#include <vector>

/// What a case says of the coordinates of a measured surface.
namespace trochoid::files {

/// A direction in the coordinates of a file. As a case has it, of any length above 0;
/// in a checked frame of length 1.
using Direction = std::array<double, 3>;

/// How the wall lies in the coordinates of a measuring machine.
struct SurfaceFrame {
  std::vector<double> origin = {0.0, 0.0, 0.0};  ///< start of the wall, at the tip [m]
  std::optional<Direction> feed;                 ///< where the tool goes
  std::optional<Direction> normal;               ///< out of the material
  std::optional<Direction> up;  ///< from the tip to the shank; absent: feed x normal
};

/// Units of lengths that a file may have.
enum class LengthUnit { mm, um, m, in, thou };

/// As files spell it.
constexpr std::string_view name_of(LengthUnit unit) noexcept {
  switch (unit) {
    case LengthUnit::mm:
      return "mm";
    case LengthUnit::um:
      return "um";
    case LengthUnit::m:
      return "m";
    case LengthUnit::in:
      return "in";
    case LengthUnit::thou:
      return "thou";
  }
  return {};
}

/// @brief Factor from a unit to SI.
constexpr double factor_of(LengthUnit unit) noexcept {
  switch (unit) {
    case LengthUnit::mm:
      return unit::mm;
    case LengthUnit::um:
      return unit::um;
    case LengthUnit::in:
      return unit::inch;
    case LengthUnit::thou:
      return unit::thou;
    default:
      return unit::one;
  }
}

}  // namespace trochoid::files
