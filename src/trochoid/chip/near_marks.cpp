#include <trochoid/chip/near_marks.h>

#include <trochoid/base/index.h>
#include <trochoid/chip/harmonics.h>

#include <algorithm>
#include <cmath>

namespace trochoid::chip {

namespace {

using base::index;

/// Whether one chip is above another for certain for u = sin(theta) from lowest to 1.
bool lies_above(const MarkEstimate& p, const MarkEstimate& q, double lowest) noexcept {
  const double sine = p.sine - q.sine;
  const double square = p.square - q.square;
  const double skew = p.skew + q.skew;
  const auto above = [&](double u) {
    return p.mean - q.mean + sine * u + square * (1 - u * u) >
           skew * std::abs(u) + p.rest + q.rest;
  };
  if (!above(lowest) || !above(1.0) || (lowest < 0 && !above(0.0))) {
    return false;
  }
  if (square >= 0) {  // bent downwards: lowest at an end
    return true;
  }
  const auto above_inside = [&](double u, double from, double to) {
    return !(u > from && u < to) || above(u);
  };
  return above_inside((sine + skew) / (2 * square), lowest, 0.0) &&
         above_inside((sine - skew) / (2 * square), std::max(lowest, 0.0), 1.0);
}

}  // namespace

std::pmr::vector<int> near_marks(const Passage& passage, const Slice& slice, int tooth,
                                 std::pmr::memory_resource& memory) {
  std::pmr::vector<MarkEstimate> chips(&memory);
  chips.reserve(index(passage.marks));
  double lowest = -1.0;
  for (int m = 1; m <= passage.marks; ++m) {
    const MarkEstimate chip = estimate_over_mark(passage, slice, tooth, m);
    if (chip.sine > chip.skew) {
      const double most = chip.mean + chip.square + chip.rest;
      const double slope = most > 0 ? chip.sine - chip.skew : chip.sine + chip.skew;
      lowest = std::max(lowest, -most / slope);
    }
    chips.push_back(chip);
  }
  lowest = std::min(lowest, 1.0);
  std::pmr::vector<int> kept(&memory);
  kept.reserve(chips.size());
  for (std::size_t m = 0; m < chips.size(); ++m) {
    const auto below = [&](const MarkEstimate& other) {
      return lies_above(chips[m], other, lowest);
    };
    if (std::none_of(chips.begin(), chips.end(), below)) {
      kept.push_back(static_cast<int>(m) + 1);
    }
  }
  return kept;
}

}  // namespace trochoid::chip
