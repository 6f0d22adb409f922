#pragma once

#include <trochoid/surface/fit_models.h>
#include <trochoid/surface/tooth_model.h>

#include <array>

namespace trochoid::surface {

/// @brief Runout that single readings show, and the coefficients found with it.
struct RunoutFit {
  bool ok = false;
  std::string message = "not fitted";  ///< when not ok, why
  bool labelled = false;     ///< false: the angle is known up to multiples of a pitch
  Estimate eccentricity;     ///< [m]
  Estimate angle;            ///< from the tip of tooth 1 towards tooth 2 [rad]
  Estimate start;            ///< envelope: where a turn begins along the wall [m]
  Estimate K_tc;             ///< fitted together with the runout [N/m^2]
  Estimate K_rc;             ///< [N/m^2]
  double correlation = 0.0;  ///< of the two
  /// Of rho cos(lambda), rho sin(lambda) [m], K_tc and K_rc [N/m^2]: row-major.
  std::array<double, 16> covariance{};
  std::vector<Estimate> datum;    ///< as of CoefficientFit
  double rms_without = 0.0;       ///< of all readings, runout left out [m]
  double rms = 0.0;               ///< [m]
  std::vector<double> predicted;  ///< shape (readings), datum included [m]
};

/// @brief Runout and coefficients from all readings, one by one.
///
/// @eq E-17 min over rho cos(lambda), rho sin(lambda), K_tc, K_rc, datum (envelope: and
///          where a turn begins) of |e - e(model)|^2, from several starts
/// @src [wang2015] section 4 in words; derived: rho cos(lambda), rho sin(lambda) in
///      place of rho, lambda, and all unknowns together
/// @param found  begins with its chosen fit
RunoutFit find_runout(const Setting& setting, std::span<const Reading> readings,
                      std::span<const Datum> datum, const ModelFits& found);

}  // namespace trochoid::surface
