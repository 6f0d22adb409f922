#pragma once

#include <trochoid/identification/identify.h>

#include <string>
#include <vector>

/// How far the numbers of a fit can be relied upon.
namespace trochoid::identification {

/// Neighbouring residuals that agree more than this are not white noise.
inline constexpr double noise_correlation = 0.3;

/// @brief Factor by which white standard errors are too small, at least 1.
///
/// @eq I-8 sqrt((1 + r)/(1 - r)) for r > 0, r counted as 0.999 at most
double correlation_factor(double r) noexcept;

/// @brief What speaks against using the numbers of a fit at all; empty: nothing.
///
/// More than half of the force (rms, within the band of the fit) stays unexplained and
/// is not white noise; or the tangential cutting coefficient may be zero; or it or the
/// radial one is negative by more than its interval.
/// @eq I-9 u_band > 1/2 and (band limit or r > 0.3)
std::vector<std::string> reasons_against(const Fit& fit);

/// @brief One sentence for a person: `Do not use these numbers: ...`.
std::string do_not_use(const std::vector<std::string>& reasons);

}  // namespace trochoid::identification
