#pragma once

#include <trochoid/surface/fit_nominal.h>

#include <memory>
#include <span>
#include <vector>

namespace trochoid::surface {

/// What ten more readings at a height would give.
struct Advice {
  double height = 0.0;   ///< [m]
  double se_K_tc = 0.0;  ///< [N/m^2]
  double se_K_rc = 0.0;  ///< [N/m^2]
};

/// @brief Coefficients from the means of readings, one fit for each way to read them.
struct ModelFits {
  std::vector<Nominal> nominal;
  std::vector<CoefficientFit> fits;  ///< linear, envelope, with feedback; never empty
  std::size_t chosen = 0;            ///< the fit with the model that the setting names
  std::vector<Advice> advice;        ///< best first; where the chosen fit is ok
  std::shared_ptr<const Stations> stations;  ///< for the heights of the readings
};

inline const CoefficientFit& chosen_fit(const ModelFits& models) {
  return models.fits[models.chosen];
}

/// @brief Cutting coefficients from a measured wall, its runout averaged out.
///
/// @eq E-15 min over K_tc, K_rc, datum of |e_N - M K - datum|^2, weights: readings in
///          each mean                                        (quasi_static, imprint)
/// @eq E-16 the same with e_N(K) of E-9, by Gauss-Newton from E-15       (envelope)
/// @src [wang2015] eq. 18; E-16 derived
/// @param datum     of each set of readings
/// @param feedback  of the last fit; none: entry is tried, and not chosen
ModelFits fit_models(const Setting& setting, std::span<const Reading> readings,
                     std::span<const Datum> datum, Feedback feedback);

/// @brief What the chosen fit says of each reading: its mean. [m]
/// @param count  of readings
/// @return shape (count)
std::vector<double> predicted_means(const ModelFits& models, std::size_t count);

}  // namespace trochoid::surface
