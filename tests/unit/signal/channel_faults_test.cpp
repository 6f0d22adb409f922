#include <trochoid/signal/channel_faults.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace trochoid::signal::channel_faults_test {

std::vector<double> sine(double amplitude, double limit) {
  std::vector<double> out;
  for (int i = 0; i < 2000; ++i) {
    out.push_back(std::min(limit, amplitude * std::sin(0.05 * i)));
  }
  return out;
}

TEST(ChannelFault, IsNoneOfAForce) {
  EXPECT_EQ(channel_fault(sine(100, 1e9)), ChannelFault::none);
  // Nothing cuts for most of the turn, and a program wrote no noise.
  EXPECT_EQ(channel_fault(sine(100, 0)), ChannelFault::none);
  EXPECT_EQ(channel_fault(std::vector<double>(10, 1.0)), ChannelFault::none) << "few";
}

TEST(ChannelFault, IsAChannelDrivenBeyondItsRange) {
  EXPECT_EQ(channel_fault(sine(100, 90)), ChannelFault::clipped);
  std::vector<double> below = sine(100, 90);
  for (double& v : below) v = -v;
  EXPECT_EQ(channel_fault(below), ChannelFault::clipped);
}

TEST(ChannelFault, IsAChannelThatDropsOut) {
  std::vector<double> values = sine(100, 1e9);
  for (std::size_t i = 700; i < 720; ++i) values[i] = values[699];
  EXPECT_EQ(channel_fault(values), ChannelFault::dropouts);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::round(values[i] / 5);
  EXPECT_NE(channel_fault(values), ChannelFault::dropouts) << "a coarse converter";
}

/// The peaks of a force stay at one number of a coarse converter, as nothing clipped does.
TEST(ChannelFault, IsNoneOfAConverterOfFewBits) {
  for (const double step : {0.5, 2.0, 5.0}) {
    std::vector<double> values = sine(100, 1e9);
    for (double& v : values) v = step * std::round(v / step);
    EXPECT_EQ(channel_fault(values), ChannelFault::none) << step;
    std::vector<double> clipped = sine(100, 90);
    for (double& v : clipped) v = step * std::round(v / step);
    EXPECT_EQ(channel_fault(clipped), ChannelFault::clipped) << step;
  }
}

TEST(ChannelFault, LeavesTheSamplesThatWereLost) {
  std::vector<double> values = sine(100, 1e9);
  for (std::size_t i = 0; i < values.size(); i += 40) {
    for (std::size_t k = 1; k < 8; ++k) values[i + k] = values[i];
  }
  EXPECT_EQ(channel_fault(values), ChannelFault::dropouts) << "7 of 40";
  const std::vector<Part> lost = lost_samples(values);
  ASSERT_EQ(lost.size(), 50u);
  EXPECT_EQ(lost[1].begin, 41u);
  EXPECT_EQ(lost[1].end, 48u);
}

TEST(ChannelFault, IsADeadChannel) {
  EXPECT_EQ(channel_fault(std::vector<double>(100, 0.0)), ChannelFault::constant);
}

}  // namespace trochoid::signal::channel_faults_test
