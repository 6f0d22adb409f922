#include <trochoid/base/units.h>
#include <trochoid/surface/error_statistics.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace trochoid::surface::error_statistics_test {

TEST(ErrorStatistics, AreThoseOfAProfile) {
  const std::array error = {1e-6, 5e-6, 3e-6, 3e-6};
  const std::array tooth = {0, 2, 2, 2};
  const ErrorStatistics s = error_statistics(error, tooth, 3);
  EXPECT_DOUBLE_EQ(s.error.mean, 3e-6);
  EXPECT_EQ(s.error.min, 1e-6);
  EXPECT_EQ(s.error.max, 5e-6);
  EXPECT_DOUBLE_EQ(s.Ra, 1e-6);
  EXPECT_EQ(s.share, (std::vector<double>{0.25, 0.0, 0.75}));
}

TEST(FeedWaves, AreToldApartOverWholeTurnsOnly) {
  constexpr int teeth = 3;
  constexpr int samples = 240;
  constexpr double turns = 2;
  std::vector<double> error;
  for (int i = 0; i < samples; ++i) {
    const double phi = unit::turn * turns * i / samples;
    error.push_back(1e-6 + 4e-6 * std::cos(phi - 0.3) + 2e-6 * std::sin(teeth * phi));
  }
  const auto waves = feed_waves(error, turns, teeth);
  ASSERT_TRUE(waves);
  EXPECT_NEAR(waves->once_per_turn, 4e-6, 1e-15);
  EXPECT_NEAR(waves->once_per_tooth, 2e-6, 1e-15);
  EXPECT_FALSE(feed_waves(error, 1.5, teeth));
  EXPECT_FALSE(feed_waves(error, 0.0, teeth));
}

}  // namespace trochoid::surface::error_statistics_test
