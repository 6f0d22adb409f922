#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace trochoid::results {

/// @brief How numbers by chance spread.
///
/// @eq U-7 low, high: where 2.5 % and 97.5 % lie below, between the sorted numbers; the
///         true ones lie between the r-th and the s-th of n with at least 95 %: r - 1 the
///         most with P(B < r) <= 2.5 %, s the least with P(B >= s) <= 2.5 %, B binomial of n
///         and that share
/// @src standard: order statistics
struct Spread {
  std::size_t count = 0;
  double min = 0.0;
  double median = 0.0;
  double max = 0.0;
  double mean = 0.0;
  double sd = 0.0;  ///< 0 of a single number
  double low = 0.0;
  double high = 0.0;
  /// Where the true ones lie; none: of so few numbers nothing bounds them.
  std::optional<std::array<double, 2>> low_between;
  std::optional<std::array<double, 2>> high_between;
};

/// @brief Of fewer numbers the ends of an interval have no bounds.
inline constexpr std::size_t least_for_bounds = 146;

/// @param values  in any order, not empty
Spread spread_of(std::vector<double> values);

}  // namespace trochoid::results
