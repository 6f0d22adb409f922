#pragma once

#include <trochoid/surface/joint_fit.h>

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

/// A reading that lies far from all others, and was left out.
struct Outlier {
  std::size_t reading = 0;  ///< which
  double residual = 0.0;    ///< how far from what the others say [m]
};

/// @brief What a measured wall tells of the cut that made it.
struct Calibration {
  bool ok = false;                     ///< are there coefficients at all
  std::string message;                 ///< when not ok, why
  ModelFits models;                    ///< from the means of the readings
  RunoutFit runout;                    ///< from all readings, together with runout
  bool runout_seen = false;            ///< it stands out of its own uncertainty
  bool with_runout = false;            ///< the fit that counts is that with runout
  FoundCoefficients coefficients;      ///< of the fit that counts
  std::vector<double> predicted;       ///< of each reading, as well as is known [m]
  std::vector<Datum> datum;            ///< of each set, as it was decided
  std::vector<DatumPart> datum_parts;  ///< what each estimate of the datum is
  std::vector<Outlier> outliers;
  std::vector<Explanation> explanations;  ///< likeliest first; empty: one was asked for
  double own_scatter = 0.0;               ///< of a reading by itself [m]
  double shared_scatter = 0.0;  ///< shared by readings of a height or a place [m]
};

/// @brief Does runout stand out of its own uncertainty?
bool is_seen(const RunoutFit& runout) noexcept;

/// @brief Cutting coefficients and runout from a measured wall.
///
/// As the options of the fit ask, readings far off are left out, what is not stated is
/// decided by the readings (fit_jointly), and the answer is that of all explanations.
/// Where everything is stated the fit of the means counts, which runout leaves alone,
/// with one exception: the mean of a real surface is not free of runout, so of an
/// envelope without feedback the fit together with runout counts where runout is seen.
///
/// @eq E-26 left out: |e_i - f_i| > 5 s, s = 1.4826 median |e - f|
/// @src [huber1981]: least squares with errors cut off
/// @param datum  of each set of readings
/// @param means_fitted  called before runout is looked for; may be empty
/// @throws std::invalid_argument where the cut leaves no single wall
Calibration calibrate(const Setting& setting, std::span<const Reading> readings,
                      std::span<const Datum> datum, const FitOptions& options = {},
                      const std::function<void()>& means_fitted = {});

}  // namespace trochoid::surface
