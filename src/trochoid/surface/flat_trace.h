#pragma once

#include <trochoid/surface/trace_fit.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace trochoid::surface {

/// The part of a turn.
inline double turn_of(double u) noexcept {
  return u - std::floor(u);
}

/// @brief A trace without the line through it, and where its readings lie on a turn.
struct FlatTrace {
  std::vector<double> x;  ///< from the first reading [m]
  std::vector<double> z;  ///< [m]
  double waviness = 0.0;  ///< what was taken out, from its lowest to its highest [m]

  [[nodiscard]] double length() const noexcept { return x.back(); }
  /// Means in bins of a turn of a feed; bins without a reading take their neighbour's.
  [[nodiscard]] std::vector<double> folded(double feed, std::size_t bins) const;
};

FlatTrace without_line(const Trace& trace);

/// @brief The same without what is longer than the feed of a turn, where that is worth it:
/// more than a tenth of the roughness, on five turns or more.
///
/// @eq W-10 z less the mean of z from x - f/2 to x + f/2, in which the marks of a turn are a
///          constant, twice; near the ends a straight line goes on
/// @src derived
FlatTrace without_waviness(const FlatTrace& flat, double feed);

/// Of heights about their mean [m].
double average_roughness(const std::vector<double>& z);

/// @brief The feed of a turn at which a trace repeats best, near the stated one [m].
double feed_that_repeats(const FlatTrace& flat, double stated);

/// @brief W-8, of what is left of a trace.
double readings_as_one(const std::vector<double>& r);

/// @brief How much of what is left repeats: the product of even and odd turns, so that
/// neighbouring readings may have as much in common as they like.
/// @return share of the power
double repeating_share(const FlatTrace& flat, const std::vector<double>& r,
                       double feed);

}  // namespace trochoid::surface
