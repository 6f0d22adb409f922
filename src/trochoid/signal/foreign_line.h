#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace trochoid::signal {

/// A vibration that does not turn with the spindle.
struct ForeignLine {
  std::size_t channel = 0;
  double frequency = 0.0;  ///< [Hz]
  double share = 0.0;      ///< its rms over that of all channels, their means left out
};

/// @brief The strongest line of the channels that lies between the harmonics of the
/// spindle: chatter, hum.
///
/// @eq S-11 share^2 = sum of |X_k|^2 over five bins about the line/sum of |X_ck|^2 over
///          all bins and channels
/// @src derived
///
/// Spectra are taken with Hann's window w; a line stands 50 times above the median power
/// between the harmonics, and more than six bins from every one of them.
/// @param rate   samples a second [Hz], even
/// @param Omega  [rad/s]
/// @return none, or one that makes 5 % of the force at least
std::optional<ForeignLine> foreign_line(
    const std::array<std::vector<double>, 3>& channels, double rate, double Omega);

}  // namespace trochoid::signal
