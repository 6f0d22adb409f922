#pragma once

#include <optional>
#include <span>
#include <vector>

namespace trochoid::surface {

/// Mean and extremes of some values.
struct MeanAndExtremes {
  double mean = 0.0;
  double min = 0.0;
  double max = 0.0;
};

/// @param values  at least one
MeanAndExtremes mean_and_extremes(std::span<const double> values);

/// @brief What the error at one height of a wall comes to.
struct ErrorStatistics {
  MeanAndExtremes error;      ///< positive: material left [m]
  double Ra = 0.0;            ///< mean distance from the mean [m]
  std::vector<double> share;  ///< of each tooth in the wall, a part from 0 to 1
};

/// @param error  at even steps along the feed, at least one [m]
/// @param tooth  that made it, 0-based, negative: none; shape of error
/// @param teeth  of the cutter
ErrorStatistics error_statistics(std::span<const double> error,
                                 std::span<const int> tooth, int teeth);

/// Amplitudes of the waves along the feed [m].
struct FeedWaves {
  double once_per_turn = 0.0;   ///< runout
  double once_per_tooth = 0.0;  ///< feed marks
};

/// @brief Waves of a profile that is sampled evenly; none where it is not over whole
/// turns.
/// @param turns  of the spindle that it is over
std::optional<FeedWaves> feed_waves(std::span<const double> error, double turns,
                                    int teeth);

}  // namespace trochoid::surface
