#pragma once

#include <string_view>

namespace trochoid::unit {

/// A unit of files: its factor to SI, and how it is written.
struct Named {
  double factor = 1.0;
  std::string_view symbol;  ///< empty: a plain number
};

/// @brief The unit that ends the name of a key or a column: `radial_depth_mm`.
Named of_key(std::string_view key) noexcept;

}  // namespace trochoid::unit
