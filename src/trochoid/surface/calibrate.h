#pragma once

#include <trochoid/base/estimate.h>
#include <trochoid/surface/nominal_model.h>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace trochoid::surface {

/// What is estimated of a measurement beside the coefficients.
struct Datum {
  bool offset = false;  ///< a constant of the readings
  bool tilt = false;    ///< slopes along the feed and over the height
};

using base::Estimate;

/// @brief One way to read the profile, and the coefficients that follow.
struct Answer {
  Model model = Model::imprint;
  Feedback feedback = Feedback::none;
  bool ok = false;
  std::string message = "not fitted";  ///< when not ok, why
  Estimate K_tc;                       ///< [N/m^2]
  Estimate K_rc;                       ///< [N/m^2]
  double correlation = 0.0;            ///< of the two
  std::vector<Estimate> datum;         ///< of each set: offset, then slopes, if asked
  int rank = 0;
  double condition = 0.0;
  double noise = 0.0;             ///< standard deviation of one reading [m]
  double rms = 0.0;               ///< of the nominal residuals [m]
  std::vector<double> residual;   ///< measured minus fitted, shape (nominals) [m]
  std::vector<double> predicted;  ///< shape (nominals) [m]
  /// Where the two cannot be told apart: the direction (K_tc, K_rc) that is known.
  std::array<double, 2> known{};
  Estimate combination;  ///< known . (K_tc, K_rc) [N/m^2]
};

/// What one more reading at a height would give.
struct Advice {
  double height = 0.0;   ///< [m]
  double se_K_tc = 0.0;  ///< with ten more readings there [N/m^2]
  double se_K_rc = 0.0;  ///< [N/m^2]
};

struct Calibration {
  std::vector<Nominal> nominal;
  std::vector<Answer> answers;               ///< linear, envelope, with feedback
  std::size_t chosen = 0;                    ///< the reading that the setting asks for
  std::vector<Advice> advice;                ///< best first
  std::shared_ptr<const Stations> stations;  ///< for the heights of the readings
};

/// @brief Cutting coefficients, and runout where it shows, from a measured wall.
///
/// @eq E-15 min over K_tc, K_rc, datum of |e_N - M K - datum|^2, weights: readings in
///          each mean                                        (quasi_static, imprint)
/// @eq E-16 the same with e_N(K) of E-9, by Gauss-Newton from E-15       (envelope)
/// @src [wang2015] eq. 18; E-16 derived
/// @param feedback  of the last answer; none: entry is tried, and not chosen
Calibration calibrate(const Setting& setting, std::span<const Reading> readings,
                      std::span<const Datum> datum, Feedback feedback);

/// Condition of D beyond which the coefficients count as not told apart: readings of a
/// micrometre then leave them open by far more than their values.
inline constexpr double worst_condition = 1000.0;

}  // namespace trochoid::surface
