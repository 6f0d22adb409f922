#include "closed_loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <string>

namespace trochoid::online_test {

using tests::ClosedLoop;
using tests::sine_config;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

/// A sine of 10 um that leads by the delay of the
/// actuator; the estimator knows no runout.
TrochoidControllerConfig loop_config() {
  auto config = sine_config(10e-6);
  config.lead_s = 2.268e-3;
  return config;
}

TrochoidOnlineConfig learning(double gain_high = 3.0) {
  TrochoidOnlineConfig c;
  trochoid_online_defaults(&c);
  c.gain_high = gain_high;
  c.gain_step = 3.0;
  c.difference_m = 20e-6;
  c.exponent = 0.3;
  return c;
}

/// First turn from which on the flutes stay within 3 %.
std::size_t turns_to_equal(const ClosedLoop& loop) {
  std::size_t first = loop.turns.size();
  for (std::size_t i = loop.turns.size() - 1; i-- > 0;) {  // the last is not complete
    if (loop.turns[i].difference() >= 0.03) {
      break;
    }
    first = i;
  }
  return first;
}

TEST(Online, FlutesAreEqualWithinFiveTurns) {  // [L-6]
  for (const double longer : {26e-6, 20e-6, 10e-6}) {
    ClosedLoop loop(loop_config(), learning(), longer);
    loop.run(30);
    if (longer == 26e-6) {
      EXPECT_GT(loop.turns[0].difference(), 0.5);
    }
    EXPECT_GE(turns_to_equal(loop), 2U);
    EXPECT_LE(turns_to_equal(loop), 5U) << longer;
    EXPECT_LT(loop.turns[29].difference(), 0.01);
  }
}

TEST(Online, CommandDoesNotOvershootTheStroke) {  // [L-6]
  // 80 um between the flutes need more stroke than there is.
  ClosedLoop loop(loop_config(), learning(100.0), 80e-6);
  loop.run(30);
  EXPECT_GE(loop.least_command, 0.0);
  EXPECT_LE(loop.most_command, 60e-6);
  EXPECT_GT(loop.most_command, 59e-6);
}

TEST(Online, GainGrowsToItsValueWithoutPassingItByATenth) {
  ClosedLoop loop(loop_config(), learning(), 26e-6);
  loop.run(30);
  const double end = loop.turns.back().gain;
  for (const auto& turn : loop.turns) {
    EXPECT_LE(turn.gain, 1.1 * end);
  }
  EXPECT_NEAR(end, 1.4, 0.05);  // 28 um for 26, as the actuator gives 0.976 of it
}

TEST(Online, ConvergesWhereTheModelIsWrong) {  // [L-6] |1 - mu d_true/d| < 1
  for (const double wrong : {0.6, 1.5}) {
    auto config = learning();
    config.difference_m *= wrong;
    ClosedLoop loop(loop_config(), config, 26e-6);
    loop.run(40);
    EXPECT_LT(loop.turns[39].difference(), 0.01) << wrong;
  }
}

TEST(Online, DivergesWhereTheSignIsWrongButStaysWithinItsLimits) {
  auto config = learning(2.0);
  config.difference_m *= -1.0;
  config.gain_low = -2.0;
  ClosedLoop loop(loop_config(), config, 26e-6);
  loop.run(20);
  EXPECT_EQ(loop.turns.back().gain, -2.0);
  EXPECT_GE(loop.least_command, 0.0);
  EXPECT_LE(loop.most_command, 60e-6);
}

TEST(Online, NoiseMovesThePeaksButNotAwayFromEqual) {
  ClosedLoop loop(loop_config(), learning(), 26e-6);
  loop.noise = 1.0;
  loop.run(40);
  for (std::size_t i = 10; i < 40; ++i) {
    EXPECT_LT(loop.turns[i].difference(), 0.03);
  }
}

TEST(Online, MeansMayBeTheMeasure) {
  auto config = learning();
  config.measure = TROCHOID_MEASURE_MEAN;
  ClosedLoop loop(loop_config(), config, 26e-6);
  loop.run(30);
  EXPECT_LT(loop.learnt.difference, 0.01);
  // Equal means take half as much again, and are not equal peaks.
  EXPECT_NEAR(loop.learnt.gain / 1.4, 1.5, 0.1);
  EXPECT_GT(loop.turns[29].difference(), 0.1);
}

/// A turn of two half sines of the peaks given, 500 samples.
TrochoidOnlineResult one_turn(TrochoidOnline& online, double first, double second,
                              const std::function<void(int, double&, double&)>& spoil) {
  TrochoidOnlineResult result{};
  int turn = TROCHOID_TURN_OPEN;
  for (int i = 0; i < 500; ++i) {
    double angle = (i + 0.5) / 500.0;
    double force = (i < 250 ? first : -second) *
                   std::fabs(std::sin(2.0 * std::numbers::pi * (i + 0.5) / 500.0));
    spoil(i, angle, force);
    result = trochoid_online_sample(&online, angle, force, 1);
    turn = result.turn != TROCHOID_TURN_OPEN ? result.turn : turn;
  }
  result.turn = turn;
  return result;
}

const auto as_it_is = [](int, double&, double&) {};

TEST(Online, ResidualIsThatOfTheRatioOfThePeaks) {  // [L-5]
  TrochoidOnline online;
  auto config = learning();
  config.exponent = 0.28;
  trochoid_online_init(&online, &config);
  // Chips of 60 and 40 um: 10 um above the mean of 50.
  const double first = 300.0 * std::pow(60.0, 0.72);
  const double second = 300.0 * std::pow(40.0, 0.72);
  one_turn(online, first, second, as_it_is);
  one_turn(online, first, second, as_it_is);
  const auto result = one_turn(online, first, second, as_it_is);
  EXPECT_NEAR(result.force_N[0], first, 1e-4 * first);
  EXPECT_NEAR(result.force_N[1], second, 1e-4 * second);
  EXPECT_NEAR(result.residual_m, 10e-6, 1e-12);
  EXPECT_NEAR(result.gain, 10.0 / 20.0, 1e-6);
  EXPECT_NEAR(result.difference, (first - second) / first, 1e-9);
}

TEST(Online, FluteThatDoesNotCutIsTheWholeFeedAway) {  // [L-5]
  TrochoidOnline online;
  const auto config = learning();
  trochoid_online_init(&online, &config);
  one_turn(online, 100.0, 0.0, as_it_is);
  one_turn(online, 100.0, 0.0, as_it_is);
  const auto result = one_turn(online, 100.0, 0.0, as_it_is);
  EXPECT_DOUBLE_EQ(result.residual_m, 50e-6);
  EXPECT_DOUBLE_EQ(result.gain, 2.5);
}

TEST(Online, TurnsThatTellNothingChangeNothing) {
  struct Case {
    int turn;
    std::function<void(int, double&, double&)> spoil;
  };
  const Case cases[] = {
      {TROCHOID_TURN_GAPS, [](int i, double&, double& f) { f = i == 77 ? nan : f; }},
      {TROCHOID_TURN_GAPS, [](int i, double& a, double&) { a = i == 300 ? inf : a; }},
      {TROCHOID_TURN_GAPS, [](int i, double& a, double&) { a = i == 300 ? 1e30 : a; }},
      {TROCHOID_TURN_GAPS,
       [](int i, double& a, double&) { a = i > 200 && i < 270 ? 0.4 : a; }},
      {TROCHOID_TURN_GAPS,
       [](int i, double& a, double&) { a = i > 200 && i < 300 ? a - 0.1 : a; }},
      {TROCHOID_TURN_NO_CUT, [](int, double&, double& f) { f *= 1e-3; }},
  };
  for (const auto& c : cases) {
    TrochoidOnline online;
    const auto config = learning();
    trochoid_online_init(&online, &config);
    TrochoidOnlineResult result{};
    for (int i = 0; i < 4; ++i) {
      result = one_turn(online, 60.0, 30.0, c.spoil);
    }
    EXPECT_EQ(result.turn, c.turn) << trochoid_turn_name(result.turn);
    EXPECT_EQ(result.gain, 0.0);
  }
}

TEST(Online, LearnsOnlyWhileTheCommandIsInForce) {
  TrochoidOnline online;
  const auto config = learning();
  trochoid_online_init(&online, &config);
  for (int i = 0; i < 3000; ++i) {
    const double angle = i / 500.0;
    const auto result = trochoid_online_sample(
        &online, angle, std::fmod(angle, 1.0) < 0.5 ? 60 : 30, 0);
    ASSERT_EQ(result.gain, 0.0);
    ASSERT_TRUE(result.turn == TROCHOID_TURN_OPEN ||
                result.turn == TROCHOID_TURN_PASSIVE);
  }
  EXPECT_DOUBLE_EQ(online.result.difference, 0.5);
}

TEST(Online, WaitsForTheSurfaceThatTheOldGainLeft) {
  TrochoidOnline online;
  auto config = learning();
  config.wait_turns = 2;
  trochoid_online_init(&online, &config);
  std::vector<int> turns;
  for (int i = 0; i < 9; ++i) {
    turns.push_back(one_turn(online, 60.0, 50.0, as_it_is).turn);
  }
  const std::vector<int> expected = {
      TROCHOID_TURN_OPEN,   TROCHOID_TURN_OPEN,   TROCHOID_TURN_LEARNT,
      TROCHOID_TURN_WAITED, TROCHOID_TURN_WAITED, TROCHOID_TURN_LEARNT,
      TROCHOID_TURN_WAITED, TROCHOID_TURN_WAITED, TROCHOID_TURN_LEARNT};
  EXPECT_EQ(turns, expected);
}

TEST(Online, BatchIsSampleBySample) {
  TrochoidOnline one;
  TrochoidOnline other;
  const auto config = learning();
  trochoid_online_init(&one, &config);
  trochoid_online_init(&other, &config);
  std::vector<double> angle;
  std::vector<double> force;
  for (int i = 0; i < 1700; ++i) {
    angle.push_back(i / 500.0);
    force.push_back(std::fmod(angle.back(), 1.0) < 0.5 ? 60 : 30);
    trochoid_online_sample(&one, angle.back(), force.back(), 1);
  }
  const auto result =
      trochoid_online_batch(&other, angle.data(), force.data(), 1700, 1);
  EXPECT_EQ(result.gain, one.result.gain);
  EXPECT_GT(result.gain, 0.0);
  EXPECT_EQ(result.turn, TROCHOID_TURN_WAITED);
  EXPECT_EQ(trochoid_online_batch(&other, nullptr, force.data(), 5, 1).turn,
            TROCHOID_TURN_NOT_READY);
}

TEST(Online, WrongConfigurationsAreRefused) {
  using Config = TrochoidOnlineConfig;
  struct Wrong {
    int refusal;
    std::function<void(Config&)> spoil;
  };
  const Wrong wrongs[] = {
      {TROCHOID_ONLINE_REFUSED_TEETH, [](Config& c) { c.teeth = 3; }},
      {TROCHOID_ONLINE_REFUSED_WINDOW, [](Config& c) { c.window_rev = 0.6; }},
      {TROCHOID_ONLINE_REFUSED_WINDOW, [](Config& c) { c.window_start_rev = nan; }},
      {TROCHOID_ONLINE_REFUSED_WINDOW, [](Config& c) { c.least_samples = 0; }},
      {TROCHOID_ONLINE_REFUSED_WINDOW, [](Config& c) { c.measure = 2; }},
      {TROCHOID_ONLINE_REFUSED_GAIN, [](Config& c) { c.gain = 4.0; }},
      {TROCHOID_ONLINE_REFUSED_GAIN, [](Config& c) { c.gain_high = inf; }},
      {TROCHOID_ONLINE_REFUSED_GAIN, [](Config& c) { c.gain_step = 0.0; }},
      {TROCHOID_ONLINE_REFUSED_CHIP, [](Config& c) { c.difference_m = 0.0; }},
      {TROCHOID_ONLINE_REFUSED_CHIP, [](Config& c) { c.feed_per_tooth_m = -1.0; }},
      {TROCHOID_ONLINE_REFUSED_CHIP, [](Config& c) { c.exponent = 1.0; }},
      {TROCHOID_ONLINE_REFUSED_LEARNING, [](Config& c) { c.rate = 0.0; }},
      {TROCHOID_ONLINE_REFUSED_LEARNING, [](Config& c) { c.least_force_N = nan; }},
      {TROCHOID_ONLINE_REFUSED_LEARNING, [](Config& c) { c.deadband = 1.0; }},
      {TROCHOID_ONLINE_REFUSED_LEARNING, [](Config& c) { c.wait_turns = -1; }},
  };
  std::set<std::string> reasons;
  for (const auto& wrong : wrongs) {
    TrochoidOnline online;
    auto config = learning();
    ASSERT_EQ(trochoid_online_init(&online, &config), TROCHOID_ONLINE_ACCEPTED);
    wrong.spoil(config);
    EXPECT_EQ(trochoid_online_init(&online, &config), wrong.refusal);
    EXPECT_EQ(trochoid_online_sample(&online, 0.0, 1.0, 1).turn,
              TROCHOID_TURN_NOT_READY);
    reasons.insert(trochoid_online_refusal_reason(wrong.refusal));
  }
  EXPECT_EQ(reasons.size(), 5U);
  const auto config = learning();
  TrochoidOnline online;
  EXPECT_EQ(trochoid_online_init(nullptr, &config), TROCHOID_ONLINE_REFUSED_POINTER);
  EXPECT_EQ(trochoid_online_init(&online, nullptr), TROCHOID_ONLINE_REFUSED_POINTER);
}

}  // namespace trochoid::online_test
