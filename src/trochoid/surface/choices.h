#pragma once

#include <string_view>

/// What a case may choose of a wall.
namespace trochoid::surface {

/// What is meant by surface error.
enum class Model {
  quasi_static,  ///< the deflection at every spindle angle, [wang2015]
  imprint,       ///< where each tooth touches the wall squarely
  envelope,      ///< what all passes leave
};

/// The names that files use.
constexpr std::string_view name_of(Model model) noexcept {
  switch (model) {
    case Model::quasi_static:
      return "quasi_static";
    case Model::imprint:
      return "imprint";
    case Model::envelope:
      return "envelope";
  }
  return {};
}

/// How the force is spread over the axial depth.
enum class Load {
  distributed,   ///< each piece of an edge at its own height
  concentrated,  ///< on the cutter at a_p/2, on the wall evenly over a_p, [wang2015]
};

/// The names that files use.
constexpr std::string_view name_of(Load load) noexcept {
  switch (load) {
    case Load::distributed:
      return "distributed";
    case Load::concentrated:
      return "concentrated";
  }
  return {};
}

/// What of the chip the deflection changes.
enum class Feedback {
  none,
  entry,         ///< where an edge meets the stock
  regenerative,  ///< entry and chip; earlier teeth were deflected as well
  direct,        ///< entry and chip, as if earlier teeth had not been deflected
};

/// The names that files use.
constexpr std::string_view name_of(Feedback feedback) noexcept {
  switch (feedback) {
    case Feedback::none:
      return "none";
    case Feedback::entry:
      return "entry";
    case Feedback::regenerative:
      return "regenerative";
    case Feedback::direct:
      return "direct";
  }
  return {};
}

/// Forces that bend cutter and wall, beside the one across the wall.
enum class AlsoBends {
  x,  ///< along the feed
  z,  ///< along the axis
};

/// The names that files use.
constexpr std::string_view name_of(AlsoBends axis) noexcept {
  switch (axis) {
    case AlsoBends::x:
      return "x";
    case AlsoBends::z:
      return "z";
  }
  return {};
}

/// What of the form of the readings is unknown, and found with the rest: each has all
/// before it as well.
enum class PlannedForm {
  none,
  offset,     ///< a constant
  tilt,       ///< slopes along the feed and over the height
  curvature,  ///< a bow over the height
};

/// The names that files use.
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
