#include "spindle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace trochoid::controller_test {

using tests::Bench;
using tests::sine_config;

constexpr double pi = std::numbers::pi;
constexpr double middle = 30e-6;

double sine(double turns) {
  return middle + 15e-6 * std::sin(2.0 * pi * turns);
}

TEST(Controller, CommandIsTheTableAheadByLeadAndHalfAPeriod) {  // [L-1]
  for (const bool resets : {false, true}) {
    auto config = sine_config();
    config.lead_s = 2.268e-3;
    config.phase_rev = 0.125;
    Bench bench(config);
    bench.spindle.resets = resets;
    ASSERT_LT(bench.until(TROCHOID_RUNNING), 1.0);
    for (int i = 0; i < 500; ++i) {
      const auto result = bench.step();
      const double ahead = 20.0 * (2.268e-3 + 0.5e-3) + 0.125;
      // 360 straight pieces of a sine: 15e-6 (pi/360)^2/2 = 0.6 nm.
      EXPECT_NEAR(result.command_m, sine(bench.spindle.turns + ahead), 0.7e-9);
      EXPECT_EQ(result.limited, 0);
    }
  }
}

TEST(Controller, UnlatchedIndexIsLateByAtMostAStep) {  // [L-1]
  Bench bench(sine_config());
  bench.spindle.latched = false;
  ASSERT_LT(bench.until(TROCHOID_RUNNING), 1.0);
  for (int i = 0; i < 500; ++i) {
    const double late = bench.spindle.turns - std::floor(bench.spindle.turns) -
                        bench.step().angle_rev + 20.0 * 1e-3;
    EXPECT_GE(late - std::floor(late + 0.5), -1e-9);
    EXPECT_LE(late - std::floor(late + 0.5), 20.0 * 1e-3 + 1e-9);
  }
}

TEST(Controller, GainScalesTheCommandUpToTheStroke) {
  Bench bench(sine_config());
  EXPECT_NEAR(trochoid_controller_gain_limit(&bench.controller), 2.0, 1e-12);
  bench.until(TROCHOID_RUNNING);
  double most = 0.0;
  for (int i = 0; i < 400; ++i) {
    auto in = bench.spindle.next();
    in.gain = 5.0;
    const auto result = bench.give(in);
    EXPECT_TRUE(result.limited & TROCHOID_LIMITED_GAIN);
    most = std::fmax(most, result.command_m);
  }
  EXPECT_NEAR(most, 60e-6, 0.05e-6);
  EXPECT_LE(most, 60e-6);
  EXPECT_EQ(bench.last.state, TROCHOID_RUNNING);
}

TEST(Controller, GainChangesAtItsRate) {
  auto config = sine_config();
  config.gain_time_s = 0.1;
  Bench bench(config);
  bench.until(TROCHOID_RUNNING);
  for (int i = 1; i <= 60; ++i) {
    auto in = bench.spindle.next();
    in.gain = 0.5;
    EXPECT_NEAR(bench.give(in).gain, std::fmax(0.5, 1.0 - 0.01 * i), 1e-12);
  }
}

TEST(Controller, CoarseSpeedIsSmoothedOverAQuarterTurn) {  // [L-2]
  // One count more or less is a quarter of the speed here.
  auto config = sine_config();
  config.period_s = 250e-6;
  config.lead_s = 2.268e-3;
  Bench bench(config);
  bench.spindle.counts = 400.0;
  bench.spindle.speed = 20.3;
  ASSERT_LT(bench.until(TROCHOID_RUNNING), 1.0);
  double most_raw = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const auto in = bench.spindle.next();
    most_raw = std::fmax(most_raw, in.speed_rps);
    EXPECT_NEAR(bench.give(in).speed_rps, 20.3, 0.02 * 20.3);
  }
  EXPECT_GT(most_raw, 1.4 * 20.3);  // so there was something to smooth
}

TEST(Controller, SpeedFollowsAsTheFormulaSays) {  // [L-2]
  Bench bench(sine_config());
  bench.run(0.1);
  double speed = 20.0;
  bench.spindle.speed = 21.0;
  for (int i = 0; i < 50; ++i) {
    const double d = 21.0 * 1e-3;
    speed += (21.0 - speed) * d / (d + 0.25);
    EXPECT_NEAR(bench.step().speed_rps, speed, 1e-12);
  }
}

TEST(Controller, SlopeIsLimitedExactly) {  // [L-3]
  auto config = sine_config();
  config.slew_m_per_s = 1e-3;  // the sine needs 1.9e-3
  Bench bench(config);
  bench.until(TROCHOID_RUNNING);
  double before = bench.last.command_m;
  int limited = 0;
  for (int i = 0; i < 500; ++i) {
    const auto result = bench.step();
    EXPECT_LE(std::fabs(result.command_m - before), 1e-3 * 1e-3);
    limited += result.limited & TROCHOID_LIMITED_SLEW;
    before = result.command_m;
  }
  EXPECT_GT(limited, 300);
}

TEST(Controller, FadesInAndOutInTheTimeSet) {
  Bench bench(sine_config());
  bench.until(TROCHOID_FADING_IN);
  EXPECT_NEAR(bench.until(TROCHOID_RUNNING), 0.3, 2e-3);
  for (int i = 1; i <= 310; ++i) {
    auto in = bench.spindle.next();
    in.enable = 0;
    const auto result = bench.give(in);
    EXPECT_NEAR(result.fade, std::fmax(0.0, 1.0 - i * 1e-3 / 0.3), 1e-9);
    if (i < 299 || i > 301) {
      EXPECT_EQ(result.state, i < 300 ? TROCHOID_FADING_OUT : TROCHOID_DISABLED) << i;
    }
  }
  EXPECT_EQ(bench.last.command_m, middle);
  EXPECT_EQ(bench.last.fault, TROCHOID_NO_PROBLEM);
}

TEST(Controller, MayBeEnabledAgainWhileItFadesOut) {
  Bench bench(sine_config());
  bench.until(TROCHOID_RUNNING);
  for (int i = 0; i < 100; ++i) {
    auto in = bench.spindle.next();
    in.enable = 0;
    bench.give(in);
  }
  EXPECT_EQ(bench.step().state, TROCHOID_FADING_IN);
  EXPECT_NEAR(bench.until(TROCHOID_RUNNING), 0.1, 2e-3);
}

TEST(Controller, DisabledRestsAtMidStroke) {
  Bench bench(sine_config());
  for (int i = 0; i < 1000; ++i) {
    auto in = bench.spindle.next();
    in.enable = 0;
    const auto result = bench.give(in);
    EXPECT_EQ(result.command_m, middle);
    EXPECT_EQ(result.state, TROCHOID_DISABLED);
  }
}

TEST(Controller, StartsWhereTheActuatorIsAndRampsToMidStroke) {
  auto config = sine_config();
  config.start_m = 0.0;
  Bench bench(config);
  double before = 0.0;
  for (int i = 0; i < 199; ++i) {
    const double now = bench.step().command_m;
    EXPECT_NEAR(now - before, 30e-6 / 200, 1e-18);
    EXPECT_NE(bench.last.state, TROCHOID_FADING_IN);
    before = now;
  }
  EXPECT_LT(bench.until(TROCHOID_FADING_IN), 0.01);
}

TEST(Controller, WaitsForGoodTurns) {
  auto config = sine_config();
  config.good_turns = 3;
  Bench bench(config);
  bench.spindle.turns = 0.5;
  // Half a turn to the first pulse, then three.
  EXPECT_NEAR(bench.until(TROCHOID_FADING_IN), 3.5 / 20.0, 2e-3);
}

TEST(Controller, NoRunWithoutIndex) {
  Bench bench(sine_config());
  bench.spindle.index = false;
  bench.run(2.0);
  EXPECT_EQ(bench.last.state, TROCHOID_WAITING);
  EXPECT_EQ(bench.last.problem, TROCHOID_INDEX_LOST);
  EXPECT_EQ(bench.last.command_m, middle);
}

TEST(Controller, WaitsWhileTheSpindleRunsUp) {
  Bench bench(sine_config());
  for (int i = 0; i < 1000; ++i) {
    bench.spindle.speed = 20.0 * i / 1000.0 + 1e-3;
    bench.step();
    // 10 % a turn is soon too slow a change to be seen; the run must not begin before.
    if (bench.spindle.speed < 5.0) {
      ASSERT_NE(bench.last.state, TROCHOID_FADING_IN);
    }
  }
}

TEST(Controller, SpeedRippleAndCoarseCountsAreNoFault) {
  auto config = sine_config();
  config.period_s = 250e-6;
  Bench bench(config);
  bench.spindle.counts = 400.0;
  bench.spindle.ripple = 0.03;
  bench.run(3.0);
  EXPECT_EQ(bench.last.state, TROCHOID_RUNNING);
  EXPECT_GT(bench.last.turns, 55);
}

TEST(Controller, SamplesAreTheSameBitsAgain) {
  std::vector<double> first;
  for (int again = 0; again < 2; ++again) {
    Bench bench(sine_config());
    for (int i = 0; i < 2000; ++i) {
      const double now = bench.step().command_m;
      if (again == 0) {
        first.push_back(now);
      } else {
        ASSERT_EQ(now, first[static_cast<std::size_t>(i)]);
      }
    }
  }
}

TEST(Controller, StateIsPlainDataThatMayBeCopied) {
  Bench bench(sine_config());
  bench.until(TROCHOID_RUNNING);
  Bench copy = bench;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(bench.step().command_m, copy.step().command_m);
  }
}

TEST(Controller, WithoutConfigurationItCommandsNothing) {
  TrochoidController controller{};
  const auto in = tests::Spindle{}.next();
  EXPECT_EQ(trochoid_controller_step(&controller, &in).state, TROCHOID_NOT_READY);
  EXPECT_EQ(trochoid_controller_step(&controller, &in).command_m, 0.0);
  EXPECT_EQ(trochoid_controller_step(nullptr, &in).command_m, 0.0);
  EXPECT_EQ(trochoid_controller_gain_limit(&controller), 0.0);
}

TEST(Controller, BeginsAnewWithItsOwnConfiguration) {
  Bench bench(sine_config());
  bench.run(1.0);
  ASSERT_EQ(trochoid_controller_init(&bench.controller, &bench.controller.config),
            TROCHOID_ACCEPTED);
  EXPECT_EQ(bench.step().state, TROCHOID_WAITING);
  EXPECT_LT(bench.until(TROCHOID_RUNNING), 1.0);
}

}  // namespace trochoid::controller_test
