#include <trochoid/surface/error_statistics.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace trochoid::surface {

namespace {

/// Amplitude of what repeats `cycles` times over a profile.
double amplitude(std::span<const double> e, std::size_t cycles) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double angle =
        unit::turn * static_cast<double>(cycles * i) / static_cast<double>(e.size());
    sum += e[i] * std::polar(1.0, -angle);
  }
  return 2 * std::abs(sum) / static_cast<double>(e.size());
}

}  // namespace

MeanAndExtremes mean_and_extremes(std::span<const double> values) {
  MeanAndExtremes found{.min = values.front(), .max = values.front()};
  for (const double v : values) {
    found.mean += v / static_cast<double>(values.size());
    found.min = std::min(found.min, v);
    found.max = std::max(found.max, v);
  }
  return found;
}

ErrorStatistics error_statistics(std::span<const double> error,
                                 std::span<const int> tooth, int teeth) {
  ErrorStatistics found{.error = mean_and_extremes(error)};
  found.share.resize(static_cast<std::size_t>(teeth));
  const double part = 1.0 / static_cast<double>(error.size());
  for (std::size_t i = 0; i < error.size(); ++i) {
    found.Ra += part * std::abs(error[i] - found.error.mean);
    if (tooth[i] >= 0) {
      found.share[static_cast<std::size_t>(tooth[i])] += part;
    }
  }
  return found;
}

std::optional<FeedWaves> feed_waves(std::span<const double> error, double turns,
                                    int teeth) {
  if (turns != std::round(turns) || turns < 1) {
    return std::nullopt;
  }
  const auto whole = static_cast<std::size_t>(turns);
  return FeedWaves{amplitude(error, whole),
                   amplitude(error, whole * static_cast<std::size_t>(teeth))};
}

}  // namespace trochoid::surface
