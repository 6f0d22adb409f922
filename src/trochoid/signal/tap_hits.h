#pragma once

#include <trochoid/signal/tap_test.h>

#include <cstddef>
#include <vector>

namespace trochoid::signal {

/// A stretch of the force above its threshold.
struct Pulse {
  std::size_t begin = 0;
  std::size_t end = 0;  ///< past the last sample
  double peak = 0.0;    ///< [N], with its sign
};

/// A hit: a pulse, and whether others follow within its block.
struct Hit {
  Pulse pulse;
  std::size_t start = 0;  ///< of its block, a little before the pulse
  TapHit told;
};

struct Hits {
  std::vector<Hit> hits;
  std::size_t length = 0;  ///< of the blocks, in samples; 0: no hit was found
};

/// @brief Hits and the length of their blocks.
/// @param block  [s]; 0: until the next hit, a second at most
Hits find_hits(const TapRecord& record, double block);

}  // namespace trochoid::signal
