#include "milling_cut.h"

#include <trochoid/dynamics/steady_state.h>

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace trochoid::dynamics {
namespace {

/// The benchmark at an axial depth; it is stable up to about 0.36 mm.
MotionProblem benchmark(double depth_mm) {
  MotionProblem p;
  p.setup = straight_cut(2, geometry::Slot{});
  p.setup.cut.a_p = depth_mm * unit::mm;
  p.law = benchmark_law();
  p.system = benchmark_system();
  p.grid.steps_per_tooth = 200;
  p.samples_per_rev = 180;
  return p;
}

TEST(SteadyState, IsReachedByAStableCut) {
  const SteadyState steady = steady_state(benchmark(0.2));
  EXPECT_EQ(steady.verdict, Verdict::periodic);
  EXPECT_EQ(steady.motion.turns_done, 20);
  EXPECT_LE(steady.motion.last_change, periodic_tolerance * steady.motion.peak);
  ASSERT_TRUE(steady.motion.growth);
  EXPECT_LT(*steady.motion.growth, chatter_growth);
}

TEST(SteadyState, FollowsMoreTurnsUntilTheMotionRepeats) {
  MotionProblem p = benchmark(0.2);
  p.revolutions = 2;
  std::vector<int> told;
  const SteadyState steady = steady_state(p, [&](int turns) { told.push_back(turns); });
  EXPECT_EQ(steady.verdict, Verdict::periodic);
  ASSERT_GT(told.size(), 1U);
  EXPECT_EQ(told[0], 2);
  EXPECT_EQ(told[1], 4);
  EXPECT_EQ(steady.motion.turns_done, told.back());
}

TEST(SteadyState, IsNotYetReachedWhereTransientsLast) {
  MotionProblem p = benchmark(0.3);  // a vibration fades by some percent in a turn
  p.revolutions = 1;
  const SteadyState steady = steady_state(p);
  EXPECT_EQ(steady.verdict, Verdict::not_periodic);
  EXPECT_EQ(steady.motion.turns_done, 8) << "doubled three times";
  EXPECT_GT(steady.motion.last_change, periodic_tolerance * steady.motion.peak);
}

TEST(SteadyState, AVibrationThatGrowsIsChatterAtOnce) {
  const SteadyState steady = steady_state(benchmark(0.5));
  EXPECT_EQ(steady.verdict, Verdict::chatter);
  EXPECT_EQ(steady.motion.turns_done, 20) << "more turns would tell nothing new";
  ASSERT_TRUE(steady.motion.growth);
  // 200 steps a tooth: good to some thousandths
  EXPECT_NEAR(*steady.motion.growth, 1.0739755867 * 1.0739755867, 5e-3);
}

TEST(SteadyState, AMotionThatRunsAwayIsChatter) {
  MotionProblem p = benchmark(0.5);
  p.system = {{mode_of(1e-5, 200, 0.011, 1, 0)}};  // the cut throws it out
  p.grid.steps_per_tooth = 1000;
  const SteadyState steady = steady_state(p);
  EXPECT_EQ(steady.verdict, Verdict::chatter);
  EXPECT_FALSE(steady.motion.finite);
  EXPECT_LT(steady.motion.turns_done, 21);
}

/// Beyond a period doubling the two teeth cut in turns, and the motion still repeats.
TEST(SteadyState, TeethThatAreAlikeAndDoNotCutAlikeAreChatter) {
  MotionProblem p = benchmark(2.5);
  p.setup.cut.engagement = geometry::UpMilling{0.6 * unit::mm};
  p.setup.cut.Omega = 19500 * unit::rpm;
  const SteadyState steady = steady_state(p);
  EXPECT_TRUE(steady.motion.periodic);
  EXPECT_GT(peak_difference(steady.motion), 0.02);
  EXPECT_EQ(steady.verdict, Verdict::chatter);
  p.setup.runout.radial_offsets = {1e-6, -1e-6};  // which this chip does not feel
  EXPECT_EQ(steady_state(p).verdict, Verdict::chatter);
  p.setup.chip.model = chip::Model::radial;  // now they are not alike
  EXPECT_EQ(steady_state(p).verdict, Verdict::periodic);
}

TEST(RelativeDifference, IsThatOfLargestAndSmallestOverTheLargest) {
  EXPECT_DOUBLE_EQ(relative_difference(std::array{4.0, 1.0, 2.0}), 0.75);
  EXPECT_EQ(relative_difference(std::array{3.0, 3.0}), 0.0);
  EXPECT_EQ(relative_difference(std::array{0.0, 0.0}), 0.0);
  EXPECT_EQ(relative_difference({}), 0.0);
  Motion m;
  m.flutes = {{.peak_y = 40, .chip_area = 1e-4}, {.peak_y = 30, .chip_area = 4e-4}};
  EXPECT_DOUBLE_EQ(peak_difference(m), 0.25);
  EXPECT_DOUBLE_EQ(area_difference(m), 0.75);
}

}  // namespace
}  // namespace trochoid::dynamics
