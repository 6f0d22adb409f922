#pragma once

#include <trochoid/signal/passes.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trochoid::signal {

/// What a channel reads without any force: a straight line over the record.
struct ChannelDrift {
  double first = 0.0;  ///< at the first sample [N]
  double last = 0.0;   ///< at the last sample [N]
  /// [N], from the scatter of whole revolutions, no less than by white noise within them.
  double first_se = 0.0;
  double last_se = 0.0;  ///< [N]
};

struct Drift {
  std::array<ChannelDrift, 3> channel;
  bool sloped = false;  ///< false: a constant only
  /// Standard error of each channel's line in the middle of the cut [N].
  std::array<double, 3> se_in_cut{};
};

/// @brief Offset and drift of each channel from its idle parts.
///
/// @eq  S-4  (a_c, b_c) = argmin of sum over the idle samples of (F_c - a - b t)^2
///
/// A slope is estimated only where idle parts lie on both sides of the cut or cover a
/// quarter of the record; else the constant alone, for it would be carried far.
/// @param idle  where nothing cuts, ascending (passes_of)
/// @param cut   from which the drift is to be removed
/// @return none where there is no whole idle turn
std::optional<Drift> idle_drift(const std::array<std::vector<double>, 3>& channels,
                                std::span<const double> angle,
                                std::span<const Part> idle, const Part& cut);

/// @brief Take a drift out of the channels.
void remove_drift(std::array<std::vector<double>, 3>& channels, const Drift& drift);

}  // namespace trochoid::signal
