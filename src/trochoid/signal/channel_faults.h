#pragma once

#include <trochoid/signal/passes.h>

#include <span>
#include <vector>

namespace trochoid::signal {

/// What a channel does that no force does.
enum class ChannelFault {
  none,
  constant,  ///< the same number in every sample
  clipped,   ///< stays at its largest or smallest number again and again
  dropouts,  ///< stays at one number for a moment, now and then, as no noisy signal does
};

/// @brief Whether a channel is dead or was driven beyond its range.
///
/// Clipped is a channel that stays at its largest or smallest number for three samples or
/// more, in at least three places and in at least one sample of a hundred, and stands there
/// at least five times as often as at the next number: a converter of few bits stays at the
/// top of a peak, too, but hardly twice as often as one step below. At zero, where nothing
/// cuts, it may. It drops out where it stays at any one number for six samples or more, in
/// less than a tenth of all, or half where no two such stretches agree and none is long,
/// although its neighbours nearly always differ.
/// @param values  [N], shape (n)
ChannelFault channel_fault(std::span<const double> values);

/// @brief Where a channel that drops out stands still, ascending; the first sample of each
/// stretch is still one that was measured, and not in it.
std::vector<Part> lost_samples(std::span<const double> values);

}  // namespace trochoid::signal
