// Memory that something else wrote into, and counters that wrap.
#include "spindle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace trochoid::controller_memory_test {

namespace {

using tests::Bench;
using tests::sine_config;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A step that was spoilt gives a command that is none, or leaves the window.
bool harmless(const TrochoidControllerResult& result) {
  return std::isfinite(result.command_m) && result.command_m >= 0.0 &&
         result.command_m <= 60e-6;
}

#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t stride = 97;
#else
constexpr std::size_t stride = 1;
#endif

}  // namespace

TEST(ControllerMemory, NoNumberOfItThatIsNoneBecomesTheCommand) {
  Bench whole(sine_config());
  ASSERT_LT(whole.until(TROCHOID_RUNNING), 1.0);
  whole.run(0.0137);
  constexpr std::size_t words = sizeof(TrochoidController) / sizeof(double);
  for (std::size_t i = 0; i < words; i += stride) {
    for (const double value : {nan, -std::numeric_limits<double>::infinity(), 1e300}) {
      Bench spoilt = whole;
      std::memcpy(reinterpret_cast<char*>(&spoilt.controller) + i * sizeof(double),
                  &value, sizeof value);
      for (int k = 0; k < 60; ++k) {  // more than a turn
        ASSERT_TRUE(harmless(spoilt.step())) << "word " << i << " " << value;
      }
    }
  }
}

TEST(ControllerMemory, TellsWhatHappenedAndRampsToTheMiddle) {
  Bench bench(sine_config());
  ASSERT_LT(bench.until(TROCHOID_RUNNING), 1.0);
  const double before = bench.last.command_m;
  bench.controller.gain = nan;
  bench.step();
  EXPECT_EQ(bench.last.state, TROCHOID_FAULT);
  EXPECT_EQ(bench.last.fault, TROCHOID_BAD_MEMORY);
  EXPECT_STREQ(trochoid_problem_name(bench.last.problem),
               "the controller's memory was overwritten");
  EXPECT_LE(std::abs(bench.last.command_m - before), 0.02 * 1e-3);
  EXPECT_LT(bench.until_rest(), 0.25);
}

TEST(ControllerMemory, ATableWithAHoleStopsTheRunWhereItIsMet) {
  Bench bench(sine_config());
  ASSERT_LT(bench.until(TROCHOID_RUNNING), 1.0);
  for (int i = 200; i < 210; ++i) {  // a step is 7 points
    bench.controller.config.table_m[i] = nan;
  }
  double time = 0.0;
  while (bench.step().state == TROCHOID_RUNNING && time < 0.1) {
    time += 1e-3;
    ASSERT_TRUE(harmless(bench.last));
  }
  EXPECT_EQ(bench.last.fault, TROCHOID_BAD_MEMORY);
  EXPECT_LE(time, 0.052);
}

TEST(ControllerMemory, SpoiltSettingsLeaveItNotReady) {
  Bench bench(sine_config());
  ASSERT_LT(bench.until(TROCHOID_RUNNING), 1.0);
  bench.controller.config.upper_m = nan;
  EXPECT_EQ(bench.step().state, TROCHOID_NOT_READY);
  EXPECT_EQ(bench.last.command_m, 0.0);
  EXPECT_EQ(bench.last.problem, TROCHOID_BAD_MEMORY);
}

namespace {

/// As a signed counter of so many bits shows a position.
double in_counter(double turns, double counts, int bits) {
  const double span = std::ldexp(1.0, bits);
  const double value = std::floor(turns * counts);
  return (value - span * std::floor(value / span + 0.5)) / counts;
}

/// Runs over the wrap; how far the command ever was from that of a counter that does
/// not wrap [m].
double largest_error(double counts, int bits, double start, double seconds) {
  auto config = sine_config();
  Bench straight(config);
  config.wrap_rev = std::ldexp(1.0, bits) / counts;
  Bench wrapping(config);
  straight.spindle.turns = start;
  wrapping.spindle.turns = start;
  straight.spindle.counts = counts;
  wrapping.spindle.counts = counts;
  double worst = 0.0;
  for (int k = 0; k < static_cast<int>(seconds * 1000); ++k) {
    straight.step();
    TrochoidControllerInput in = wrapping.spindle.next();
    in.position_rev = in_counter(wrapping.spindle.turns, counts, bits);
    in.index_position_rev =
        in_counter(std::floor(wrapping.spindle.turns), counts, bits);
    wrapping.give(in);
    EXPECT_EQ(wrapping.last.fault, TROCHOID_NO_PROBLEM)
        << trochoid_problem_name(wrapping.last.fault);
    worst =
        std::fmax(worst, std::fabs(wrapping.last.command_m - straight.last.command_m));
  }
  EXPECT_EQ(wrapping.last.state, TROCHOID_RUNNING);
  return worst;
}

}  // namespace

TEST(ControllerCounter, ThatWrapsWithinATurnIsCountedRight) {  // [L-8]
  // int32 at 1000 counts a turn wraps after 4294967.296 turns: at 2147483.648.
  EXPECT_LT(largest_error(1000, 32, 2147453.3, 3.0), 1e-12);
  EXPECT_LT(largest_error(1000, 16, 0.3, 4.0), 1e-12);   // every 65.536 turns
  EXPECT_LT(largest_error(40000, 16, 0.3, 2.0), 1e-12);  // every 1.6384 turns
}

TEST(ControllerCounter, UnsaidAWrapWithinATurnIsAFault) {  // [L-4]
  Bench bench(sine_config());
  bench.spindle.turns = 2147453.3;
  bench.spindle.counts = 1000;
  bool fault = false;
  for (int k = 0; k < 3000; ++k) {
    TrochoidControllerInput in = bench.spindle.next();
    in.position_rev = in_counter(bench.spindle.turns, 1000, 32);
    in.index_position_rev = in_counter(std::floor(bench.spindle.turns), 1000, 32);
    bench.give(in);
    fault = fault || bench.last.fault == TROCHOID_BAD_POSITION;
  }
  EXPECT_TRUE(fault);
}

TEST(ControllerWaves, AreAddedToTheTableAtItsAngle) {  // [L-7]
  auto config = sine_config(5e-6);
  config.slew_m_per_s = 1.0;
  Bench bench(config);
  double worst = 0.0;
  for (int k = 0; k < 2000; ++k) {
    TrochoidControllerInput in = bench.spindle.next();
    in.cosine_m[0] = 3e-6;
    in.sine_m[2] = -4e-6;
    in.cosine_m[7] = 1e-6;
    bench.give(in);
    if (k > 1500) {
      const double angle =
          2 * std::numbers::pi * (bench.last.angle_rev + 0.5 * 20.0 * config.period_s);
      const double wanted = 30e-6 + 5e-6 * std::sin(angle) + 3e-6 * std::cos(angle) -
                            4e-6 * std::sin(3 * angle) + 1e-6 * std::cos(8 * angle);
      worst = std::fmax(worst, std::fabs(bench.last.command_m - wanted));
    }
  }
  EXPECT_EQ(bench.last.state, TROCHOID_RUNNING);
  EXPECT_LT(worst, 1e-9);  // straight lines between the table's points
}

TEST(ControllerWaves, ThatAreNoNumbersAreABadInput) {
  Bench bench(sine_config());
  ASSERT_LT(bench.until(TROCHOID_RUNNING), 1.0);
  TrochoidControllerInput in = bench.spindle.next();
  in.sine_m[3] = nan;
  EXPECT_EQ(bench.give(in).fault, TROCHOID_BAD_INPUT);
  EXPECT_TRUE(harmless(bench.last));
}

}  // namespace trochoid::controller_memory_test
