#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace trochoid::numerics {

/// @brief The value that would stand at a place if the values were sorted.
/// @param values  not empty; their order is lost
/// @param place   0 to values.size() - 1
inline double value_at_rank(std::vector<double>& values, std::size_t place) {
  const auto at = std::next(values.begin(), static_cast<std::ptrdiff_t>(place));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// @brief The median: of an even number of values the upper one of the middle two.
/// @param values  not empty
inline double median(std::vector<double> values) {
  return value_at_rank(values, values.size() / 2);
}

}  // namespace trochoid::numerics
