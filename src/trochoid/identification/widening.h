#pragma once

#include <trochoid/identification/identify.h>

#include <array>
#include <span>
#include <vector>

namespace trochoid::identification {

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
