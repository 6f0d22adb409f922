#pragma once

#include <trochoid/base/warning.h>

#include <array>
#include <string>
#include <vector>

namespace trochoid::signal {

/// @brief A measured force record as it stands in its file, in SI.
struct Record {
  std::string file;                            ///< for messages
  std::array<std::vector<double>, 3> channel;  ///< [N], shape (n) each
  /// Channels 4 to 8 of a sensor that has so many, in N, N m or W, shape (n) each.
  std::vector<std::vector<double>> further = {};
  /// A channel that the file does not hold is zero.
  std::array<bool, 3> measured = {true, true, true};
  std::vector<double> angle;  ///< spindle angle phi [rad], shape (n); empty: unknown
  std::vector<double> time;   ///< [s], shape (n); rebuilt from the rate; empty: unknown
  std::vector<double> line;   ///< of an NC program, shape (n); empty: unknown
  double sample_rate = 0.0;   ///< [Hz]; 0: unknown
  std::array<std::string, 3> channel_column;     ///< names in the file, for people
  std::vector<std::string> further_column = {};  ///< the same of `further`
  std::string angle_column;                      ///< the same; empty: none
  std::string time_column;                       ///< the same
  std::vector<base::Warning> notes;              ///< what the reader had to assume

  /// Channel c, from 0.
  [[nodiscard]] std::vector<double>& values_of(std::size_t c) {
    return c < 3 ? channel[c] : further[c - 3];
  }
  [[nodiscard]] std::size_t channels() const noexcept { return 3 + further.size(); }
  [[nodiscard]] std::size_t size() const noexcept { return channel[0].size(); }
};

}  // namespace trochoid::signal
