#pragma once

#include <trochoid/base/estimate.h>

#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::surface {

using base::Estimate;

/// What is estimated of a measurement beside the coefficients.
struct Datum {
  bool offset = false;  ///< a constant of the readings
  bool tilt = false;    ///< slopes along the feed and over the height
};

/// Where a reading or a mean of readings lies.
struct Spot {
  double x = 0.0;
  double height = 0.0;
  std::size_t set = 0;
};

/// @brief Columns of the datum parameters: an offset of each set, then its slopes.
struct DatumColumns {
  std::size_t count = 0;
  std::vector<double> values;  ///< row-major, shape (spots, count)
};

DatumColumns datum_columns(std::span<const Spot> spots, std::span<const Datum> datum);

/// @brief Value, standard error and 95 % interval.
/// @param freedom  degrees of freedom of the variance
Estimate estimate(double value, double variance, int freedom);

}  // namespace trochoid::surface
