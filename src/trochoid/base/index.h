#pragma once

#include <cstddef>

namespace trochoid::base {

/// A count or a place that is an int elsewhere, as the index of a container.
constexpr std::size_t index(int i) noexcept {
  return static_cast<std::size_t>(i);
}

}  // namespace trochoid::base
