#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace trochoid::surface {

/// @brief A profile that repeats with the feed, cut where something else writes it.
struct PeriodicProfile {
  double period = 0.0;         ///< [m]
  std::vector<double> breaks;  ///< ascending, from 0 to the period [m]
  std::vector<int> tooth;      ///< who wrote each piece, 0-based, shape (breaks - 1)
  /// Height [m] on a piece, at x within it; smooth there.
  std::function<double(std::size_t piece, double x)> height;
};

/// @brief Roughness of a profile [m].
///
/// @eq W-1 R_a = mean |z - mean z|, R_q = rms of z - mean z, R_t = max z - min z
/// @src definition of the standard ISO 4287, as remembered
struct Roughness {
  double mean = 0.0;
  double lowest = 0.0;
  double highest = 0.0;
  double Ra = 0.0;
  double Rq = 0.0;
  double Rz = 0.0;
  double Rt = 0.0;
  double cutoff = 0.0;  ///< of the filter it was taken behind; 0: none
};

/// @brief Of one period, without a filter: the sampling length is the period, so that
/// R_z = R_t.
Roughness roughness(const PeriodicProfile& profile);

/// @brief Behind a Gaussian filter, over five cutoffs from x = 0; R_z is the mean of the
/// five.
///
/// @eq W-2 harmonic k of the period is passed by 1 - exp(-pi (alpha cutoff k/period)^2),
///         alpha = sqrt(ln 2/pi)
/// @src standard ISO 16610-21, as remembered
/// @param cutoff  [m], above 0
Roughness filtered_roughness(const PeriodicProfile& profile, double cutoff);

/// @brief Which fraction of the profile each tooth wrote.
/// @return shape (teeth), sum 1
std::vector<double> shares(const PeriodicProfile& profile, std::size_t teeth);

/// @brief Height and tooth at a place of the first period.
struct ProfilePoint {
  double height = 0.0;  ///< [m]
  int tooth = 0;        ///< 0-based
};
ProfilePoint profile_at(const PeriodicProfile& profile, double x);

}  // namespace trochoid::surface
