#pragma once

#include <trochoid/surface/find_runout.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace trochoid::surface {

/// The coefficients that count, whichever fit they are from.
struct FoundCoefficients {
  Estimate K_tc;                ///< [N/m^2]
  Estimate K_rc;                ///< [N/m^2]
  double correlation = 0.0;     ///< of the two
  std::vector<Estimate> datum;  ///< of each set: offset, then slopes, if asked
  double rms = 0.0;             ///< of what was fitted: means, or all readings [m]
};

/// @brief What a measured wall tells of the cut that made it.
struct Calibration {
  bool ok = false;                 ///< are there coefficients at all
  std::string message;             ///< when not ok, why
  ModelFits models;                ///< from the means of the readings
  RunoutFit runout;                ///< from all readings, together with runout
  bool runout_seen = false;        ///< it stands out of its own uncertainty
  bool with_runout = false;        ///< the fit that counts is that with runout
  FoundCoefficients coefficients;  ///< of the fit that counts
  std::vector<double> predicted;   ///< of each reading, as well as is known [m]
};

/// @brief Does runout stand out of its own uncertainty?
bool is_seen(const RunoutFit& runout) noexcept;

/// @brief Cutting coefficients and runout from a measured wall.
///
/// The fit of the means counts, which runout leaves alone, with one exception: the mean
/// of a real surface is not free of runout, so of an envelope without feedback the fit
/// together with runout counts where runout is seen.
/// @param datum     of each set of readings
/// @param feedback  of the deflection; what is fitted with runout goes without
/// @param means_fitted  called before runout is looked for; may be empty
/// @throws std::invalid_argument where the cut leaves no single wall
Calibration calibrate(const Setting& setting, std::span<const Reading> readings,
                      std::span<const Datum> datum, Feedback feedback,
                      const std::function<void()>& means_fitted = {});

}  // namespace trochoid::surface
