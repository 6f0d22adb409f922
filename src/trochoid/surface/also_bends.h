#pragma once

#include <string_view>

namespace trochoid::surface {

/// Forces that bend cutter and wall, beside the one across the wall.
enum class AlsoBends {
  x,  ///< along the feed
  z,  ///< along the axis
};

/// Names of files.
constexpr std::string_view name_of(AlsoBends axis) noexcept {
  switch (axis) {
    case AlsoBends::x:
      return "x";
    case AlsoBends::z:
      return "z";
  }
  return {};
}

}  // namespace trochoid::surface
