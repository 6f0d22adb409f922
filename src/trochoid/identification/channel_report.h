#pragma once

#include <trochoid/base/estimate.h>

#include <optional>
#include <vector>

namespace trochoid::identification {

using base::Estimate;
using base::Normal;

/// @brief A sum of weights times coefficients that is known where they are not.
struct KnownSum {
  std::vector<double> weights;  ///< shape (coefficients), the first that is not 0 is 1
  double value = 0.0;  ///< [SI], in the unit of the coefficient of the first weight
  double se = 0.0;
};

/// What a fit to the channels of a sensor says beyond those to forces in x, y and z.
struct ChannelReport {
  std::vector<KnownSum> combinations;  ///< of coefficients that are not known alone
  std::vector<std::optional<Normal>> prior;         ///< [SI]; empty: none
  std::vector<std::optional<Estimate>> data_alone;  ///< without the prior [SI]
  int rank_with_prior = 0;
  double weighted_rss = 0.0;     ///< of the data alone: sum of (residual/sd)^2
  double variance_factor = 1.0;  ///< by which variances are larger than stated
  std::vector<double> rms;       ///< residual of each channel [N, N m, W]
  std::vector<double> sd;        ///< of a value of each channel, as weighted
  double sensor_angle = 0.0;     ///< [rad]
  std::optional<double> sensor_se;
  std::vector<std::optional<double>>
      axial_offsets_se;                     ///< [m], shape (teeth), or empty
  std::optional<double> tilt_se;            ///< [rad]
  std::optional<double> tilt_angle_se;      ///< [rad]
  std::vector<std::vector<double>> fitted;  ///< of each measurement, as its values
  std::vector<bool> has_phase;              ///< false: it is a mean
};

}  // namespace trochoid::identification
