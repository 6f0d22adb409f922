#include <trochoid/signal/channel_faults.h>

#include <algorithm>

namespace trochoid::signal {

namespace {

constexpr std::size_t fewest_samples = 30;
constexpr std::size_t stay = 3;         ///< samples in a row
constexpr std::size_t least_stays = 3;  ///< places
constexpr double least_share = 0.01;    ///< of all samples

bool stays_at(std::span<const double> values, double limit) {
  std::size_t stays = 0;
  std::size_t samples = 0;
  std::size_t row = 0;
  for (const double v : values) {
    row = v == limit ? row + 1 : 0;
    stays += row == stay ? 1 : 0;
    samples += row == stay ? stay : (row > stay ? 1 : 0);
  }
  return stays >= least_stays && static_cast<double>(samples) >=
                                     least_share * static_cast<double>(values.size());
}

}  // namespace

ChannelFault channel_fault(std::span<const double> values) {
  if (values.size() < fewest_samples) {
    return ChannelFault::none;
  }
  const auto [lo, hi] = std::ranges::minmax(values);
  if (lo == hi) {
    return ChannelFault::constant;
  }
  const bool clipped =
      (lo != 0 && stays_at(values, lo)) || (hi != 0 && stays_at(values, hi));
  return clipped ? ChannelFault::clipped : ChannelFault::none;
}

}  // namespace trochoid::signal
