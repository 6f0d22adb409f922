#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/surface/calibrate.h>

#include <span>
#include <string>

/// Mistakes in how a wall was described, which a fit may swallow.
namespace trochoid::run {

/// @brief Why an answer is none: a coefficient below zero, and whether all readings have
/// the wrong sign.
/// @return empty: both coefficients are above zero
std::string why_negative(const inputs::Case& given,
                         std::span<const surface::Reading> readings,
                         const surface::Calibration& calibration);

/// @brief Whether x seems to be counted from elsewhere than the end of the wall.
///
/// Tried is the middle of the readings at [wall] position_mm.
/// @return a sentence that names the better origin; empty: nothing speaks against x
std::string origin_doubt(const inputs::Case& given,
                         std::span<const surface::Reading> readings,
                         const surface::Calibration& calibration);

/// @brief Take the runout back where the readings follow feedback that the case leaves
/// out: it would hide a part of it.
void withdraw_hidden_runout(const inputs::Case& given,
                            std::span<const surface::Reading> readings,
                            std::span<const surface::Datum> datum,
                            surface::Calibration& calibration);

}  // namespace trochoid::run
