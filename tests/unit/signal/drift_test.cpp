#include <gtest/gtest.h>
#include <trochoid/signal/drift.h>

#include <cmath>
#include <numbers>
#include <random>

namespace trochoid::signal {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr int a_turn = 100;

struct Made {
  int before = 20;   ///< idle revolutions
  int entering = 5;  ///< revolutions in which the force grows
  int cutting = 40;
  int after = 20;
  double noise = 1.0;
};

struct Samples {
  std::array<std::vector<double>, 3> channel;
  std::vector<double> angle;
};

Samples make(const Made& m) {
  std::mt19937 random(11);
  std::normal_distribution<double> white(0.0, 1.0);
  const int turns = m.before + m.entering + m.cutting + m.after;
  Samples s;
  for (int i = 0; i < turns * a_turn; ++i) {
    const double phi = i * turn / a_turn;
    const double number = phi / turn;
    double depth = 0.0;
    if (number >= m.before && number < turns - m.after) {
      depth = m.entering > 0 ? std::min(1.0, (number - m.before) / m.entering) : 1.0;
    }
    const double x = static_cast<double>(i) / (turns * a_turn - 1);
    s.angle.push_back(phi);
    const double force = depth * 200.0 * std::pow(std::sin(phi), 2);
    s.channel[0].push_back(force + 15.0 - 40.0 * x + m.noise * white(random));
    s.channel[1].push_back(-force + 7.0 + m.noise * white(random));
    s.channel[2].push_back(0.1 * force - 60.0 + 10.0 * x + m.noise * white(random));
  }
  return s;
}

// [S-4]
TEST(IdleDrift, IsFoundBeforeAndAfterTheCut) {
  const auto s = make({});
  const auto drift = idle_drift(s.channel, s.angle);
  ASSERT_TRUE(drift);
  ASSERT_EQ(drift->idle.size(), 2u);
  EXPECT_TRUE(drift->sloped);
  EXPECT_LE(drift->idle[0].end, 20u * a_turn);
  EXPECT_GE(drift->idle[1].begin, 65u * a_turn);
  // 3600 idle samples with 1 N of noise: 0.02 N; at the ends less than 0.05 N.
  EXPECT_NEAR(drift->channel[0].first, 15.0, 0.2);
  EXPECT_NEAR(drift->channel[0].last, -25.0, 0.2);
  EXPECT_NEAR(drift->channel[1].first, 7.0, 0.2);
  EXPECT_NEAR(drift->channel[2].last, -50.0, 0.2);
  EXPECT_GT(drift->channel[0].first_se, 0.0);
  EXPECT_LT(drift->channel[0].first_se, 0.1);
}

TEST(IdleDrift, HasNoSlopeFromAShortAirCutAtOneEnd) {
  auto s = make({.before = 6, .after = 0});
  for (std::size_t i = 0; i < s.angle.size(); ++i) {  // no drift here
    s.channel[0][i] +=
        40.0 * static_cast<double>(i) / static_cast<double>(s.angle.size());
  }
  const auto drift = idle_drift(s.channel, s.angle);
  ASSERT_TRUE(drift);
  EXPECT_EQ(drift->idle.size(), 1u);
  EXPECT_FALSE(drift->sloped);
  EXPECT_NEAR(drift->channel[0].first, 15.0, 0.3);
  EXPECT_EQ(drift->channel[0].first, drift->channel[0].last);
}

TEST(IdleDrift, IsNotFoundWhereTheToolAlwaysCuts) {
  const auto s = make({.before = 0, .entering = 0, .after = 0});
  EXPECT_FALSE(idle_drift(s.channel, s.angle));
  // Nor where it never does, nor in too few revolutions.
  const auto idle = make({.before = 40, .entering = 0, .cutting = 0, .after = 0});
  EXPECT_FALSE(idle_drift(idle.channel, idle.angle));
  const auto few = make({.before = 1, .entering = 0, .cutting = 2, .after = 0});
  EXPECT_FALSE(idle_drift(few.channel, few.angle));
}

TEST(IdleDrift, DoesNotTakeALighterCutForIdle) {
  auto s = make({.before = 0, .entering = 0, .cutting = 40, .after = 0});
  for (auto& channel : s.channel) {
    for (std::size_t i = 0; i < 15u * a_turn; ++i) channel[i] *= 0.35;
  }
  EXPECT_TRUE(idle_parts(s.channel, s.angle).empty());
}

TEST(IdleDrift, DoesNotTakeASlowEntryForIdle) {
  const auto s = make({.before = 10, .entering = 60, .after = 0});
  const auto parts = idle_parts(s.channel, s.angle);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_LE(parts[0].end, 11u * a_turn);
}

TEST(IdleDrift, IsExactWithoutNoise) {
  const auto s = make({.noise = 0.0});
  const auto drift = idle_drift(s.channel, s.angle);
  ASSERT_TRUE(drift);
  EXPECT_NEAR(drift->channel[0].first, 15.0, 1e-9);
  EXPECT_NEAR(drift->channel[0].last, -25.0, 1e-9);
}

TEST(SteadyPart, LeavesEntryExitAndAirOut) {
  const auto s = make({});
  const Part part = steady_part(s.channel, s.angle);
  // 20 idle turns and 5 of entry; the last of these has 90 % of the force.
  EXPECT_GE(part.begin, 24u * a_turn);
  EXPECT_LE(part.begin, 25u * a_turn);
  EXPECT_EQ(part.end, 65u * a_turn);
}

TEST(SteadyPart, IsTheWholeOfAShortRecord) {
  const auto s = make({.before = 0, .entering = 0, .cutting = 3, .after = 0});
  const Part part = steady_part(s.channel, s.angle);
  EXPECT_EQ(part.begin, 0u);
  EXPECT_EQ(part.end, s.angle.size());
}

TEST(RemoveDrift, TakesTheLineOut) {
  auto s = make({.noise = 0.0});
  const auto drift = idle_drift(s.channel, s.angle);
  ASSERT_TRUE(drift);
  remove_drift(s.channel, *drift);
  EXPECT_NEAR(s.channel[0].front(), 0.0, 1e-9);
  EXPECT_NEAR(s.channel[0].back(), 0.0, 1e-9);
  EXPECT_NEAR(s.channel[0][40 * a_turn + 25], 200.0, 1e-9);
}

}  // namespace
}  // namespace trochoid::signal
