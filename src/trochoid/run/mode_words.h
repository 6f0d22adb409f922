#pragma once

#include <string>
#include <vector>

namespace trochoid::run {

/// Of one mode, for a sentence.
struct ModeWords {
  double omega = 0.0;  ///< natural frequency [rad/s]
  double zeta = 0.0;   ///< damping ratio
};

/// @brief `2 modes: 721 Hz (damping ratio 1.2 %) and 1024 Hz (2.3 %)`; of many the first.
std::string mode_words(const std::vector<ModeWords>& modes);

/// @brief `0.2 % of the power of the response stays unexplained`, after a blank.
/// @param explained  1 less what is left over, of sums of squares
std::string unexplained_power(double explained);

}  // namespace trochoid::run
