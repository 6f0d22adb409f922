#include <trochoid/signal/channel_faults.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::signal {

namespace {

constexpr std::size_t fewest_samples = 30;
constexpr std::size_t stay = 3;         ///< samples in a row
constexpr std::size_t least_stays = 3;  ///< places
constexpr double least_share = 0.01;    ///< of all samples
constexpr double heaped = 5.0;          ///< times as often as at the next number
constexpr std::size_t still = 6;        ///< samples in a row of a dropout
constexpr double few_lost = 0.1;        ///< of all samples: whatever the stretches are
constexpr double most_lost = 0.5;       ///< of all samples
constexpr double longest_lost = 0.05;   ///< of all samples, of one stretch

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

/// Whether a channel stands at a limit much more often than at the number next to it.
bool heaps_at(std::span<const double> values, double limit) {
  double next = std::numeric_limits<double>::infinity();  // away from the limit
  std::size_t at_limit = 0;
  std::size_t at_next = 0;
  for (const double v : values) {
    const double off = std::abs(v - limit);
    at_limit += off == 0.0 ? 1 : 0;
    if (off == 0.0 || off > next) continue;
    at_next = off < next ? 1 : at_next + 1;
    next = off;
  }
  return static_cast<double>(at_limit) >= heaped * static_cast<double>(at_next);
}

bool clipped_at(std::span<const double> values, double limit) {
  return limit != 0 && stays_at(values, limit) && heaps_at(values, limit);
}

/// Whether many stretches are lost samples, and not air without noise: each is short, and
/// stands at a number of its own.
bool differ(std::span<const double> values) {
  const std::vector<Part> parts = lost_samples(values);
  std::vector<double> numbers;
  for (const Part& part : parts) {
    if (static_cast<double>(part.size()) >
        longest_lost * static_cast<double>(values.size())) {
      return false;
    }
    numbers.push_back(values[part.begin]);
  }
  std::ranges::sort(numbers);
  return numbers.size() >= 3 && std::ranges::adjacent_find(numbers) == numbers.end();
}

/// Whether a signal whose samples nearly always differ stands still for a moment.
bool drops_out(std::span<const double> values) {
  constexpr double alike_elsewhere = 0.02;  // of pairs of neighbours
  std::size_t held = 0;                     // samples of stretches that stand still
  std::size_t alike = 0;                    // other pairs that agree
  std::size_t row = 1;
  for (std::size_t i = 1; i <= values.size(); ++i) {
    if (i < values.size() && values[i] == values[i - 1]) {
      ++row;
      continue;
    }
    (row >= still ? held : alike) += row >= still ? row : row - 1;
    row = 1;
  }
  const auto n = static_cast<double>(values.size());
  return held > 0 && static_cast<double>(held) < most_lost * n &&
         (static_cast<double>(held) < few_lost * n || differ(values)) &&
         static_cast<double>(alike) < alike_elsewhere * n;
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
  if (clipped_at(values, lo) || clipped_at(values, hi)) return ChannelFault::clipped;
  return drops_out(values) ? ChannelFault::dropouts : ChannelFault::none;
}

std::vector<Part> lost_samples(std::span<const double> values) {
  std::vector<Part> out;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= values.size(); ++i) {
    if (i < values.size() && values[i] == values[i - 1]) continue;
    if (i - begin >= still) out.push_back({begin + 1, i});
    begin = i;
  }
  return out;
}

}  // namespace trochoid::signal
