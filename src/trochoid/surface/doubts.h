#pragma once

#include <trochoid/surface/calibrate.h>

#include <optional>
#include <span>

/// Mistakes in how a wall was described, which a fit may swallow.
namespace trochoid::surface {

/// Why coefficients below zero came out.
struct NegativeCoefficients {
  bool wrong_sign = false;  ///< turned round, the readings give sensible ones: these
  Estimate K_tc;            ///< [N/m^2]
  Estimate K_rc;            ///< [N/m^2]
};

/// @brief Whether a calibration is none because a coefficient is below zero, and whether
/// that is because all readings have the wrong sign.
/// @return nothing: both coefficients are above zero, or all readings are 0
std::optional<NegativeCoefficients> negative_coefficients(
    const Setting& setting, std::span<const Reading> readings,
    const Calibration& calibration);

/// Another origin of x, and what the readings give with it.
struct OriginDoubt {
  double first = 0.0;    ///< of the readings, as they are [m]
  double by = 0.0;       ///< so much farther along they may lie [m]
  bool better = false;   ///< they fit better there; else as well
  double rms = 0.0;      ///< left as they are [m]
  double new_rms = 0.0;  ///< left there [m]
  Estimate K_tc;         ///< there [N/m^2]
  Estimate K_rc;         ///< there [N/m^2]
};

/// @brief Whether x seems to be counted from elsewhere than the end of the wall.
///
/// Tried is the middle of the readings at the place where the cutter was.
/// @param length    of the wall [m]
/// @param position  of the cutter along it [m]
/// @return nothing: nothing speaks against x
std::optional<OriginDoubt> origin_doubt(const Setting& setting,
                                        std::span<const Reading> readings,
                                        const Calibration& calibration, double length,
                                        double position);

/// @brief Whether the readings follow a feedback of the deflection that the fit leaves out:
/// it would hide a part of the runout.
/// @param options  of the calibration
/// @return the eccentricity with feedback [m]; nothing: they do not
std::optional<Estimate> eccentricity_hidden_by_feedback(
    const Setting& setting, std::span<const Reading> readings,
    std::span<const Datum> datum, FitOptions options, const Calibration& calibration);

}  // namespace trochoid::surface
