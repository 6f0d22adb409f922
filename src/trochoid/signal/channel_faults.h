#pragma once

#include <span>

namespace trochoid::signal {

/// What a channel does that no force does.
enum class ChannelFault {
  none,
  constant,  ///< the same number in every sample
  clipped,   ///< stays at its largest or smallest number again and again
};

/// @brief Whether a channel is dead or was driven beyond its range.
///
/// Clipped is a channel that stays at its largest or smallest number for three samples or
/// more, in at least three places and in at least one sample of a hundred. At zero, where
/// nothing cuts, it may.
/// @param values  [N], shape (n)
ChannelFault channel_fault(std::span<const double> values);

}  // namespace trochoid::signal
