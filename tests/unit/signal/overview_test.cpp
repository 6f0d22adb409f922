#include <trochoid/signal/overview.h>

#include <trochoid/base/units.h>

#include <gtest/gtest.h>

namespace trochoid::signal::overview_test {

TEST(Overview, HoldsTheExtremesOfEachPieceAndWhatIsUsed) {
  Record record;
  std::vector<double> angle;
  for (int i = 0; i < 6000; ++i) {
    angle.push_back(0.01 * unit::turn * i);
    record.time.push_back(0.001 * i);
    for (auto& channel : record.channel) channel.push_back(i == 1234 ? 50.0 : -1.0 * i);
  }
  const Overview all = overview_of(record, angle, {1000, 3000});
  ASSERT_EQ(all.turn.size(), 600U);
  EXPECT_EQ(all.high[1][123], 50.0);
  EXPECT_EQ(all.low[1][123], -1239.0);
  EXPECT_NEAR(all.turn[123], 12.35, 1e-9);
  EXPECT_NEAR(all.time[123], 1.235, 1e-12);
  EXPECT_FALSE(all.used[99]);
  EXPECT_TRUE(all.used[100]);
  EXPECT_TRUE(all.used[299]);
  EXPECT_FALSE(all.used[300]);
}

}  // namespace trochoid::signal::overview_test
