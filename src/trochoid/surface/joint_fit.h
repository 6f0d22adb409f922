#pragma once

#include <trochoid/surface/find_runout.h>
#include <trochoid/surface/scatter.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trochoid::surface {

/// @brief How a wall is fitted.
struct FitOptions {
  std::optional<Feedback> feedback = Feedback::none;  ///< none: as the readings decide
  bool robust = false;                                ///< readings far off are left out
  bool shared = false;  ///< readings of one height or place may share an error (E-20)
};

/// @brief What is found with everything as stated, the form no more than an offset.
struct StatedFits {
  ModelFits models;
  RunoutFit runout;  ///< not ok: the means alone are fitted
};

/// @brief One explanation of the readings.
struct Explanation {
  Feedback feedback = Feedback::none;
  Form form = Form::none;    ///< beside what is stated
  double weight = 0.0;       ///< how likely it is among those tried
  Estimate K_tc;             ///< [N/m^2]
  Estimate K_rc;             ///< [N/m^2]
  double correlation = 0.0;  ///< of the two
  Estimate eccentricity;     ///< [m]; 0 where runout is not fitted
  double rms = 0.0;          ///< [m]
};

/// @brief Coefficients, and runout where the readings show it, from all explanations.
struct JointFit {
  bool ok = false;
  std::string message = "not fitted";     ///< when not ok, why
  std::vector<Explanation> explanations;  ///< likeliest first
  bool with_runout = false;
  RunoutFit fit;              ///< runout, coefficients, datum, residuals
  double own_scatter = 0.0;   ///< of a reading by itself [m]
  double shared_scatter = 0;  ///< that readings of a height or a place share [m]
};

/// @brief What the readings say, whichever explanation is true.
///
/// @eq E-22 d_0 + d_x (x - x_m) + d_h (h - h_m) + d_c u^2, u in [-1, 1] over the heights
/// @eq E-24 weight ~ exp(-(nu/2) ln chi^2) |C|^(1/2) prod 1/tau_k; mean and covariance
///          are those over all explanations, what these differ by included
/// @src derived: [kass1995]; explanations are equally likely beforehand
/// @param stated  of the same readings: where the search begins
JointFit fit_jointly(const Setting& setting, std::span<const Reading> readings,
                     std::span<const Datum> datum, const FitOptions& options,
                     const StatedFits& stated);

}  // namespace trochoid::surface
