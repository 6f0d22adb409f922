#include <gtest/gtest.h>
#include <trochoid/signal/revolutions.h>

#include <cmath>
#include <numbers>
#include <random>

namespace trochoid::signal::revolutions_test {

constexpr double turn = 2.0 * std::numbers::pi;

struct Samples {
  std::array<std::vector<double>, 3> channel;
  std::vector<double> angle;
};

Samples make(int n, double a_turn, double noise = 0.0) {
  std::mt19937 random(7);
  std::normal_distribution<double> white(0.0, 1.0);
  Samples s;
  for (int i = 0; i < n; ++i) {
    const double phi = i * turn / a_turn;
    s.angle.push_back(phi);
    s.channel[0].push_back(10.0 * std::sin(phi) + noise * white(random));
    s.channel[1].push_back(5.0 * std::cos(2.0 * phi) + noise * white(random));
    s.channel[2].push_back(3.0 + noise * white(random));
  }
  return s;
}

// [S-2]
TEST(Fold, GivesTheMeanOfEachBin) {
  const auto s = make(3 * 72, 72.0);
  const auto one = fold(s.channel, s.angle, 72);
  EXPECT_EQ(one.revolutions, 3);
  for (std::size_t k = 0; k < 72; ++k) {
    EXPECT_EQ(one.count[k], 3);
    // Every sample lies at the lower edge of its bin.
    const double phi = one.angle[k] - 0.5 * turn / 72;
    EXPECT_NEAR(one.mean[0][k], 10.0 * std::sin(phi), 1e-9);
    EXPECT_NEAR(one.scatter[0][k], 0.0, 1e-9);
  }
}

TEST(Fold, DoesNotTakeTheSlopeOfTheForceForScatter) {
  const auto s = make(100000, 101.37);
  const auto one = fold(s.channel, s.angle, 36);
  EXPECT_EQ(one.revolutions, 986);
  for (std::size_t k = 0; k < 36; ++k) {
    // A bin of 10 degrees: the curvature within it leaves less than 10 (0.17)^2/24.
    EXPECT_NEAR(one.mean[0][k], 10.0 * std::sin(one.angle[k]), 0.013);
    EXPECT_LT(one.scatter[0][k], 0.013);
  }
}

TEST(Fold, FindsTheScatterOfTheNoise) {
  const auto s = make(200000, 101.37, 2.0);
  const auto one = fold(s.channel, s.angle, 36);
  for (std::size_t k = 0; k < 36; ++k) {
    // 5500 samples a bin: the deviation is known to 1 %, 5 sigma are 5 %.
    EXPECT_NEAR(one.scatter[2][k], 2.0, 0.1);
    EXPECT_NEAR(one.mean[2][k], 3.0, 0.15);
  }
}

TEST(Fold, CountsTheMeanAndTheLineAsUsed) {
  // Two turns at the same angles, 1 N apart: deviation 1/sqrt(2).
  auto s = make(20, 10.0);
  for (std::size_t i = 0; i < 20; ++i) s.channel[2][i] = i < 10 ? 1.0 : 2.0;
  EXPECT_NEAR(fold(s.channel, s.angle, 10).scatter[2][4], std::sqrt(0.5), 1e-12);
  // Four samples of one bin, +-1 about a line: sum of squares 4, two of them used up.
  const std::vector<double> angle = {0.1, 0.2, 0.3, 0.4};
  const std::vector<double> y = {1.0 + 1, 2.0 - 1, 3.0 - 1, 4.0 + 1};
  EXPECT_NEAR(fold({y, y, y}, angle, 1).scatter[0][0], std::sqrt(2.0), 1e-12);
}

TEST(Fold, DoesNotCarryNoiseBeyondTheSamplesOfABin) {
  // A sample a turn for each bin, all in its first tenth: a line read in the middle would
  // be ten times as far out as their mean.
  std::vector<double> angle;
  std::vector<double> y;
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < 8; ++k) {
      angle.push_back(turn * (i + (k + 0.018 * i) / 8));
      y.push_back(i % 2 == 0 ? 1.0 + 0.1 * i : -1.0 + 0.1 * i);
    }
  }
  const auto one = fold({y, y, y}, angle, 8);
  for (std::size_t k = 0; k + 1 < 8; ++k) {
    EXPECT_LT(std::abs(one.mean[0][k]), 0.5) << k;
  }
}

TEST(Fold, LeavesOutThePartOfATurnAtTheEnd) {
  auto s = make(250, 100.0);
  for (std::size_t i = 200; i < 250; ++i) s.channel[0][i] = 1e6;
  const auto one = fold(s.channel, s.angle, 10);
  EXPECT_EQ(one.revolutions, 2);
  for (const double y : one.mean[0]) EXPECT_LT(std::abs(y), 20.0);
}

TEST(Fold, KeepsARecordShorterThanATurn) {
  const auto s = make(50, 100.0);
  const auto one = fold(s.channel, s.angle, 10);
  EXPECT_EQ(one.revolutions, 0);
  EXPECT_EQ(one.count[0], 10);
  EXPECT_EQ(one.count[9], 0);
  EXPECT_TRUE(std::isnan(one.mean[0][9]));
}

TEST(Fold, RefusesShapesThatDiffer) {
  const auto s = make(50, 100.0);
  const std::vector<double> angle(49, 0.0);
  EXPECT_THROW(fold(s.channel, angle, 10), std::invalid_argument);
  EXPECT_THROW(fold(s.channel, s.angle, 0), std::invalid_argument);
}

TEST(Unwrapped, ContinuesTheAngleOfAnEncoderEitherWayRound) {
  const std::vector<double> forth = {6.0, 6.2, 0.1, 0.3};
  const auto up = unwrapped(forth);
  EXPECT_NEAR(up[2], 0.1 + turn, 1e-12);
  EXPECT_NEAR(up[3], 0.3 + turn, 1e-12);
  const std::vector<double> back = {0.3, 0.1, 6.2, 6.0, 3.0, 0.1, 6.1};
  const auto down = unwrapped(back);
  EXPECT_NEAR(down[3], 6.0 - turn, 1e-12);
  EXPECT_NEAR(down[6], 6.1 - 2.0 * turn, 1e-12);
}

}  // namespace trochoid::signal::revolutions_test
