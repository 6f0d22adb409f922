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
  /// A channel that the file does not hold is zero.
  std::array<bool, 3> measured = {true, true, true};
  std::vector<double> angle;  ///< spindle angle phi [rad], shape (n); empty: unknown
  std::vector<double> time;   ///< [s], shape (n); rebuilt from the rate; empty: unknown
  double sample_rate = 0.0;   ///< [Hz]; 0: unknown
  std::array<std::string, 3> channel_column;  ///< names in the file, for people
  std::string angle_column;                   ///< the same; empty: none
  std::string time_column;                    ///< the same
  std::vector<base::Warning> notes;           ///< what the reader had to assume

  [[nodiscard]] std::size_t size() const noexcept { return channel[0].size(); }
};

}  // namespace trochoid::signal
