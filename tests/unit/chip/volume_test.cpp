#include "made_slice.h"

#include <trochoid/chip/volume.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trochoid::chip::volume_test {

double widest(const MadeSlice& s) {
  double R = 0.0;
  for (const auto& tooth : s.teeth) R = std::max(R, tooth.R);
  return R;
}

/// Part of the width that stays behind as a cusp at one full edge of the cut.
double cusp(const MadeSlice& s, double width) {
  const double f = s.cutter.teeth() * s.cut.f_z;
  return f * f / (12 * widest(s)) / width;
}

TEST(Volume, OfASlotIsTheFeedTimesTheWidthButForCusps) {  // [C-8]
  std::mt19937 random(21);
  for (int n = 0; n < 60; ++n) {
    const MadeSlice s = random_slice(random, 50e-6);
    const Removal volume = removal(s.passage(), s.slice());
    const double width = 2 * widest(s);
    const double f = s.cutter.teeth() * s.cut.f_z;
    EXPECT_NEAR(volume.available, f * width, 1e-18);
    const double left = 1 - volume.removed / volume.available;
    // the longest tooth alone sets the edge, hence cusps of the feed per turn at most
    EXPECT_GT(left, -1e-9) << n;
    EXPECT_LT(left, 1.05 * 2 * cusp(s, width) + 1e-9) << n;
  }
}

TEST(Volume, OfABandInsideTheCutterIsExact) {  // [C-8]
  std::mt19937 random(22);
  for (int n = 0; n < 60; ++n) {
    MadeSlice s = random_slice(random, 50e-6);
    const double R = s.cutter.profile.D / 2;
    std::uniform_real_distribution<double> part(-0.8, 0.8);
    const auto [lo, hi] = std::minmax({part(random) * R, part(random) * R});
    s.cut.engagement = geometry::Band{lo, hi};
    const Removal volume = removal(s.passage(), s.slice());
    EXPECT_NEAR(volume.removed / volume.available, 1.0, 2e-8) << n;
  }
}

TEST(Volume, CountedFromThePreviousToothAloneIsTooMuch) {  // [C-8]
  const MadeSlice all = paper_slice(Lookback::all);
  const MadeSlice previous = paper_slice(Lookback::previous);
  const Removal right = removal(all.passage(), all.slice());
  const Removal wrong = removal(previous.passage(), previous.slice());
  EXPECT_NEAR(right.removed / right.available, 1.0, 2e-5);
  EXPECT_NEAR(wrong.removed / wrong.available, 1.019, 5e-4);
}

TEST(Volume, NothingIsRemovedWithoutFeed) {
  const MadeSlice s = made_slice(10e-3, 2, 0.0, {.radial_offsets = {0.0, 5e-6}});
  EXPECT_EQ(removal(s.passage(), s.slice()).removed, 0.0);
}

}  // namespace trochoid::chip::volume_test
