#include <trochoid/surface/probe.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace trochoid::surface {

std::vector<double> probe_reading(std::span<const double> profile, double step,
                                  double radius) {
  const std::size_t n = profile.size();
  const auto [low, high] = std::minmax_element(profile.begin(), profile.end());
  // Farther out the sphere stands clear of the highest point.
  const double depth = std::min(*high - *low, radius);
  const double reach = std::sqrt(depth * (2 * radius - depth));
  const auto steps = static_cast<std::size_t>(reach / step);
  std::vector<double> reading(profile.begin(), profile.end());
  for (std::size_t k = 1; k <= steps; ++k) {
    const double dx = static_cast<double>(k) * step;
    const double rise = radius - std::sqrt(radius * radius - dx * dx);
    std::size_t after = k % n;
    std::size_t before = (n - k % n) % n;
    for (std::size_t i = 0; i < n; ++i) {
      const double beside = std::max(profile[after], profile[before]);
      reading[i] = std::max(reading[i], beside - rise);  // E-13
      after = after + 1 == n ? 0 : after + 1;
      before = before + 1 == n ? 0 : before + 1;
    }
  }
  return reading;
}

double reading_on_slope(double radius, double slope) noexcept {
  return radius * slope * slope / (std::sqrt(1 + slope * slope) + 1);  // E-14
}

std::vector<double> readings_on_slopes(double radius, std::span<const double> heights,
                                       std::span<const double> mean) {
  const std::size_t n = heights.size();
  std::vector<double> more(n);
  for (std::size_t i = 0; n > 1 && i < n; ++i) {
    const std::size_t b = n == 2 ? 0 : std::clamp<std::size_t>(i, 1, n - 2) - 1;
    const auto chord = [&](std::size_t k, std::size_t l) {
      return (mean[l] - mean[k]) / (heights[l] - heights[k]);
    };
    double slope = chord(b, b + 1);
    if (n > 2) {
      const double bend = (chord(b + 1, b + 2) - slope) / (heights[b + 2] - heights[b]);
      slope += bend * (2 * heights[i] - heights[b] - heights[b + 1]);
    }
    more[i] = reading_on_slope(radius, slope);
  }
  return more;
}

}  // namespace trochoid::surface
