#include <trochoid/surface/probe.h>

#include <gtest/gtest.h>

#include <cmath>

namespace trochoid::surface::probe_slopes_test {

TEST(ProbeOnSlopes, FollowsAParabolaAtUnevenHeights) {  // [E-14]
  const std::vector<double> heights = {0.3e-3, 0.5e-3, 1.1e-3, 2.7e-3};
  std::vector<double> mean;
  for (const double z : heights) {
    mean.push_back(8e-5 - 0.06 * z + 11.0 * z * z);
  }
  const double r = 0.5e-3;
  const auto more = readings_on_slopes(r, heights, mean);
  ASSERT_EQ(more.size(), heights.size());
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double s = -0.06 + 22.0 * heights[i];
    EXPECT_NEAR(more[i], r * (std::hypot(1.0, s) - 1.0), 1e-15);
  }
}

TEST(ProbeOnSlopes, OfTwoHeightsTakesTheChordOfOneNothing) {  // [E-14]
  const std::vector<double> two = {1e-3, 2e-3};
  const std::vector<double> mean = {5e-5, 1e-5};
  for (const double more : readings_on_slopes(1e-3, two, mean)) {
    EXPECT_NEAR(more, 1e-3 * (std::hypot(1.0, 0.04) - 1.0), 1e-16);
  }
  const auto one = std::vector<double>{1e-3};
  EXPECT_EQ(readings_on_slopes(1e-3, one, one), std::vector<double>{0.0});
}

}  // namespace trochoid::surface::probe_slopes_test
