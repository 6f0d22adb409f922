#pragma once

#include <cstddef>
#include <vector>

namespace trochoid::base {

/// Evenly spaced values, both ends included.
struct Steps {
  double first = 0.0;
  double last = 0.0;
  double count = 0.0;  ///< a whole number, once it has been checked; 1: of `last`
};

inline std::vector<double> values(const Steps& steps) {
  const auto count = static_cast<std::size_t>(steps.count);
  std::vector<double> all;
  all.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    all.push_back(i + 1 == count ? steps.last
                                 : steps.first + share * (steps.last - steps.first));
  }
  return all;
}

}  // namespace trochoid::base
