#include <trochoid/results/spread.h>

#include <boost/math/distributions/binomial.hpp>

#include <algorithm>
#include <cmath>

namespace trochoid::results {

namespace {

constexpr double tail = 0.025;

/// Between two of the sorted values, as far on as the share says.
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto i = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(i);
  return i + 1 < sorted.size() ? sorted[i] + part * (sorted[i + 1] - sorted[i])
                               : sorted.back();
}

/// Places, from 1, of the sorted values between which the lower end lies (U-7).
std::optional<std::array<std::size_t, 2>> places_of_low(std::size_t count) {
  if (count < least_for_bounds) {
    return std::nullopt;
  }
  const auto n = static_cast<double>(count);
  const boost::math::binomial_distribution<double> below(n, tail);
  const double about = tail * n;
  const double reach = 4 * std::sqrt(about) + 4;
  auto r = static_cast<std::size_t>(std::max(0.0, about - reach));
  while (boost::math::cdf(below, static_cast<double>(r)) <= tail) {
    ++r;
  }
  auto s = static_cast<std::size_t>(std::max(1.0, about));
  while (boost::math::cdf(boost::math::complement(below, static_cast<double>(s) - 1)) >
         tail) {
    ++s;
  }
  return std::array{r, s};
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  std::ranges::sort(values);
  const auto n = static_cast<double>(values.size());
  Spread out{.count = values.size(),
             .min = values.front(),
             .median = quantile(values, 0.5),
             .max = values.back(),
             .low = quantile(values, tail),
             .high = quantile(values, 1 - tail)};
  for (const double value : values) {
    out.mean += value / n;
  }
  double squares = 0.0;
  for (const double value : values) {
    squares += (value - out.mean) * (value - out.mean);
  }
  out.sd = values.size() > 1 ? std::sqrt(squares / (n - 1)) : 0.0;
  if (const auto places = places_of_low(values.size())) {
    const auto [r, s] = *places;
    const std::size_t last = values.size() - 1;
    out.low_between = {values[r - 1], values[s - 1]};
    out.high_between = {values[last - (s - 1)], values[last - (r - 1)]};
  }
  return out;
}

}  // namespace trochoid::results
