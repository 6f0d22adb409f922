#pragma once

#include <string_view>

namespace trochoid::surface {

/// What of the form of the readings is unknown, and found with the rest: each has all
/// before it as well.
enum class PlannedForm {
  none,
  offset,     ///< a constant
  tilt,       ///< slopes along the feed and over the height
  curvature,  ///< a bow over the height
};

/// Names of files.
constexpr std::string_view name_of(PlannedForm form) noexcept {
  switch (form) {
    case PlannedForm::none:
      return "none";
    case PlannedForm::offset:
      return "offset";
    case PlannedForm::tilt:
      return "tilt";
    case PlannedForm::curvature:
      return "curvature";
  }
  return {};
}

}  // namespace trochoid::surface
