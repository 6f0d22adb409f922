#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

/// Forces of a slot that look like real ones, for pages to show. Not for comparison.
namespace sample {

struct Cut {
  std::vector<double> offsets_mm;
  double feed_mm = 0.04;
};

constexpr double deg = std::numbers::pi / 180.0;

inline std::size_t before(const Cut& cut, std::size_t tooth) {
  return (tooth + cut.offsets_mm.size() - 1) % cut.offsets_mm.size();
}

/// Chip thickness [mm] of a tooth at the immersion angle theta [deg].
inline double chip(const Cut& cut, std::size_t tooth, double theta) {
  const double rise = cut.offsets_mm[tooth] - cut.offsets_mm[before(cut, tooth)];
  return std::max(0.0, cut.feed_mm * std::sin(theta * deg) + rise);
}

inline std::array<double, 3> force(const Cut& cut, double phi) {
  constexpr int slices = 40;
  std::array<double, 3> f{};
  for (std::size_t tooth = 0; tooth < cut.offsets_mm.size(); ++tooth) {
    for (int i = 0; i < slices; ++i) {
      const double step = 360.0 / static_cast<double>(cut.offsets_mm.size());
      const double lag = 16.5 * (i + 0.5) / slices;
      const double theta =
          std::fmod(phi - static_cast<double>(tooth) * step - lag + 720.0, 360.0);
      const double h = theta < 180.0 ? chip(cut, tooth, theta) : 0.0;
      if (h <= 0.0) continue;
      const double t = (2620.0 * h + 7.0) * 2.0 / slices;
      const double r = (1560.0 * h + 3.0) * 2.0 / slices;
      f[0] += -t * std::cos(theta * deg) - r * std::sin(theta * deg);
      f[1] += t * std::sin(theta * deg) - r * std::cos(theta * deg);
      f[2] += -(331.0 * h + 1.0) * 2.0 / slices;
    }
  }
  return f;
}

/// Repeatable scatter in [-1, 1).
inline double scatter(std::uint32_t& state) {
  state = state * 1664525U + 1013904223U;
  return static_cast<double>(state >> 8U) / 8388608.0 - 1.0;
}

}  // namespace sample
