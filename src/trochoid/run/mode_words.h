#pragma once

#include <trochoid/structure/identify_modes.h>

#include <span>
#include <string>

namespace trochoid::run {

/// @brief `2 modes: 721 Hz (damping ratio 1.2 %) and 1024 Hz (2.3 %)`; of many the first.
std::string mode_words(std::span<const structure::FittedMode> modes);

/// @brief `0.2 % of the power of the response stays unexplained`, after a blank.
/// @param explained  1 less what is left over, of sums of squares
std::string unexplained_power(double explained);

}  // namespace trochoid::run
