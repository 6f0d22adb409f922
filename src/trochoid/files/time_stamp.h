#pragma once

#include <optional>
#include <string_view>

namespace trochoid::files {

/// A time of day of some day, in two numbers: one would have no digits left for samples.
struct TimeStamp {
  double days = 0.0;     ///< since the first of 2000; 0: no date is said
  double seconds = 0.0;  ///< since midnight

  /// Seconds from another one to this.
  [[nodiscard]] double since(const TimeStamp& other) const noexcept {
    constexpr double seconds_of_day = 86400.0;
    return seconds_of_day * (days - other.days) + (seconds - other.seconds);
  }
};

/// @brief A time of day, with or without a date before it: `12:00:00.0001`,
/// `2023-05-04 12:00:00.0001`, `04.05.2023 12:00:00,0001`, `05/04/2023 12:00:00`.
///
/// Of `a/b/year` the day is whatever is beyond 12, else b.
/// @return none: it is something else
std::optional<TimeStamp> time_of_stamp(std::string_view text);

}  // namespace trochoid::files
