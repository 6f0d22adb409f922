#pragma once

namespace trochoid::base {

/// An estimate and how well it is known.
struct Estimate {
  double value = 0.0;
  double se = 0.0;    ///< one standard error
  double low = 0.0;   ///< of the 95 % interval, by Student's t
  double high = 0.0;  ///< of the 95 % interval
};

/// Mean and standard deviation of what is known beforehand.
struct Normal {
  double mean = 0.0;
  double sd = 0.0;
};

/// Half of a 95 % interval over its standard error, where that itself is well known.
inline constexpr double normal_interval = 1.96;

}  // namespace trochoid::base
