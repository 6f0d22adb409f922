#pragma once

#include <trochoid/cases/case.h>
#include <trochoid/results/simulate.h>

#include <vector>

/// Parts of `simulate`.
namespace trochoid::run {

/// @brief Spindle angles that a [sampling] asks for [rad].
std::vector<double> sampled_angles(const cases::Sampling& sampling);

/// @brief Set the computed forces of a case beside its measurements.
///
/// Only the phase of each record is sought; coefficients and runout stay as given.
/// @param[out] warnings  what was found out on the way
/// @throws base::InputError when a measurement cannot be read
std::vector<results::Comparison> compare(const cases::Case& given,
                                         std::vector<base::Warning>& warnings);

}  // namespace trochoid::run
