#pragma once

#include <trochoid/identification/fit.h>

#include <array>
#include <span>
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
/// is not white noise; or the tangential cutting coefficient may be zero, or is known to no
/// better than two thirds of it; or it or the radial one is negative by more than its interval.
/// @eq I-9 u_band > 1/2 and (band limit or r > 0.3)
std::vector<std::string> reasons_against(const Fit& fit);

/// @brief Which cutting coefficients are known too little to be used without care, one phrase
/// each: to 10 % only, of itself or of a third of the tangential one, or by intervals ten
/// times as wide as noise would make them.
std::vector<std::string> poorly_known(const Fit& fit);

/// @brief One sentence for a person: `Do not use these numbers: ...`.
std::string do_not_use(const std::vector<std::string>& reasons);

/// @brief Factor by which intervals are wider than white noise would make them, at least 1.
///
/// What a fit leaves is told apart into what repeats turn by turn, which no further turn
/// averages away, and what scatters about it. Each counts by how much its neighbours
/// agree.
///
/// @eq I-13 f^2 = sum over runs of n (s_w^2 c(r_w)^2 + T s_m^2 c(r_m)^2) / RSS,
///          c(r)^2 = (1 + r)/(1 - r); s_m^2 the variance of the mean turn, less what
///          scatter makes of it, s_w^2 that about it, T samples to a bin of the mean turn;
///          at most n/(unknowns + 1): as if no more than one equation were left over
/// @src derived; c(r) standard (effective number of samples of an AR(1) process)
/// @param fitted    force of each run, as Fit::fitted
/// @param unknowns  of the fit
double interval_widening(std::span<const Run> runs,
                         std::span<const std::vector<std::array<double, 3>>> fitted,
                         int unknowns);

}  // namespace trochoid::identification
