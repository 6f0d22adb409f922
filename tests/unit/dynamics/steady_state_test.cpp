#include "milling_cut.h"

#include <trochoid/dynamics/chatter.h>
#include <trochoid/dynamics/lobes.h>
#include <trochoid/dynamics/steady_state.h>

#include <gtest/gtest.h>

#include <array>
#include <variant>
#include <vector>

namespace trochoid::dynamics::steady_state_test {

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

TEST(SteadyState, IsReachedByAStableCut) {  // [T-15]
  const SteadyState steady = steady_state(benchmark(0.2));
  ASSERT_TRUE(std::holds_alternative<Periodic>(steady.verdict));
  const auto& periodic = std::get<Periodic>(steady.verdict);
  EXPECT_EQ(periodic.passes, 1) << "the teeth are alike";
  EXPECT_EQ(periodic.passes_of_cut, 1);
  EXPECT_FALSE(chatters(steady.verdict));
  EXPECT_EQ(steady.motion.turns_done, 20);
  EXPECT_LE(steady.motion.last_change, periodic_tolerance * steady.motion.peak);
  ASSERT_TRUE(steady.motion.growth);
  EXPECT_LT(*steady.motion.growth, chatter_growth);
}

TEST(SteadyState, OfUnequalTeethRepeatsWithEveryTurn) {  // [T-15]
  MotionProblem p = benchmark(0.2);
  p.setup.chip.model = chip::Model::radial;
  p.setup.runout.radial_offsets = {5e-6, -5e-6};
  const SteadyState steady = steady_state(p);
  ASSERT_TRUE(std::holds_alternative<Periodic>(steady.verdict));
  EXPECT_EQ(std::get<Periodic>(steady.verdict).passes, 2);
  EXPECT_EQ(std::get<Periodic>(steady.verdict).passes_of_cut, 2);
  EXPECT_FALSE(chatters(steady.verdict));
  EXPECT_TRUE(walls_repeat(steady));
}

TEST(SteadyState, FollowsMoreTurnsUntilTheMotionRepeats) {
  MotionProblem p = benchmark(0.36);
  p.revolutions = 2;
  std::vector<int> told;
  const SteadyState steady = steady_state(p, [&](int turns) { told.push_back(turns); });
  EXPECT_EQ(name_of(steady.verdict), "periodic");
  ASSERT_GT(told.size(), 1U);
  EXPECT_EQ(told[0], 20) << "no verdict rests on fewer";
  EXPECT_EQ(told[1], 40);
  EXPECT_EQ(steady.motion.turns_done, told.back());
}

TEST(SteadyState, IsNotYetReachedWhereTransientsLast) {
  MotionProblem p = benchmark(0.402);  // a vibration fades by a percent in a turn
  p.revolutions = 1;
  const SteadyState steady = steady_state(p);
  ASSERT_TRUE(std::holds_alternative<Bounded>(steady.verdict));
  EXPECT_TRUE(std::get<Bounded>(steady.verdict).fades);
  EXPECT_FALSE(chatters(steady.verdict));
  EXPECT_EQ(steady.motion.turns_done, 160) << "doubled three times";
  EXPECT_GT(steady.motion.last_change, periodic_tolerance * steady.motion.peak);
}

/// It grows until teeth leave the cut, and then no more; the frequency is that of D-12.
TEST(SteadyState, AVibrationThatGrowsIsLimitedByTeethThatLeaveTheCut) {
  const MotionProblem p = benchmark(0.5);
  const SteadyState steady = steady_state(p);
  ASSERT_TRUE(steady.motion.growth);
  // 200 steps a tooth: good to some thousandths
  EXPECT_NEAR(*steady.motion.growth, 1.0739755867 * 1.0739755867, 5e-3);
  ASSERT_TRUE(std::holds_alternative<Bounded>(steady.verdict));
  const auto& bounded = std::get<Bounded>(steady.verdict);
  EXPECT_FALSE(bounded.fades);
  EXPECT_TRUE(chatters(steady.verdict));
  EXPECT_FALSE(walls_repeat(steady));
  EXPECT_GT(bounded.amplitude[0], 0.3 * p.setup.cut.f_z) << "teeth leave the cut";
  EXPECT_LT(bounded.amplitude[0], 4 * p.setup.cut.f_z);
  EXPECT_EQ(bounded.amplitude[1], 0.0) << "there is no mode along y";
  const VibrationLine* line = chatter_line(bounded);
  ASSERT_NE(line, nullptr);
  // A little above the mode, and near what the linearised cut has: a large vibration is
  // another one than a small one.
  EXPECT_NEAR(line->frequency, 950, 40);
}

TEST(SteadyState, IsJudgedByAllTurnsSoFar) {
  // The transient of the start is larger than what grows: 20 turns seem to settle.
  MotionProblem p = benchmark(0.42);
  const SteadyState steady = steady_state(p);
  EXPECT_TRUE(chatters(steady.verdict));
  EXPECT_GT(steady.motion.turns_done, 20);
}

TEST(SteadyState, AMotionThatRunsAwayGrows) {
  MotionProblem p = benchmark(0.5);
  p.system = {{mode_of(1e-5, 200, 0.011, 1, 0)}};  // the cut throws it out
  p.grid.steps_per_tooth = 1000;
  const SteadyState steady = steady_state(p);
  EXPECT_EQ(name_of(steady.verdict), "growing");
  EXPECT_TRUE(chatters(steady.verdict));
  EXPECT_FALSE(steady.motion.finite);
  EXPECT_LT(steady.motion.turns_done, 21);
}

/// Beyond a period doubling the two teeth cut in turns, and the motion still repeats.
TEST(SteadyState, TeethThatAreAlikeAndDoNotCutAlikeAreChatter) {  // [T-15]
  MotionProblem p = benchmark(2.5);
  p.setup.cut.engagement = geometry::UpMilling{0.6 * unit::mm};
  p.setup.cut.Omega = 19500 * unit::rpm;
  const SteadyState steady = steady_state(p);
  ASSERT_TRUE(std::holds_alternative<Periodic>(steady.verdict));
  const auto& periodic = std::get<Periodic>(steady.verdict);
  EXPECT_EQ(periodic.passes, 2);
  EXPECT_EQ(periodic.passes_of_cut, 1);
  EXPECT_TRUE(chatters(steady.verdict));
  EXPECT_TRUE(walls_repeat(steady)) << "two teeth are a turn";
  EXPECT_GT(peak_difference(steady.motion), 0.02);
  p.setup.runout.radial_offsets = {1e-6, -1e-6};  // which this chip does not feel
  EXPECT_TRUE(chatters(steady_state(p).verdict));
  p.setup.chip.model = chip::Model::radial;  // now they are not alike
  EXPECT_FALSE(chatters(steady_state(p).verdict));
}

/// Period doubling of interrupted cutting, where the multiplier passes -1: two teeth are a
/// turn of two, two thirds of one of three and two turns of one.
TEST(SteadyState, RepeatsAfterTwoTeethBeyondAPeriodDoubling) {  // [T-15]
  struct Flip {
    int teeth;
    double a_e_mm;
    double rpm;
    double beyond;  ///< of the limit depth; of one tooth it grows slowly
  };
  for (const auto& [teeth, a_e, rpm, factor] :
       {Flip{2, 0.6, 19500, 1.1}, Flip{3, 0.27, 13000, 1.1},
        Flip{1, 2.26, 37500, 1.03}}) {
    SCOPED_TRACE(teeth);
    MotionProblem p = benchmark(1.0);
    p.setup.cutter.pitch = geometry::equal_pitch(teeth);
    p.setup.cut.engagement = geometry::UpMilling{a_e * unit::mm};
    p.setup.cut.Omega = rpm * unit::rpm;
    const DirectionalModel model(p.setup, p.law, 1e-6, 1e-10);
    std::vector<double> depths;
    for (int i = 1; i <= 40; ++i) {
      depths.push_back(0.1 * i * unit::mm);
    }
    const auto limit = limit_depth(model, p.system, p.setup.cut.Omega, depths, 1e-6);
    ASSERT_TRUE(limit);
    EXPECT_EQ(bifurcation_of(limit->multiplier), Bifurcation::period_doubling);
    p.setup.cut.a_p = factor * limit->depth;
    p.grid.steps_per_tooth = 1000;
    const SteadyState beyond = steady_state(p);
    ASSERT_TRUE(std::holds_alternative<Periodic>(beyond.verdict));
    EXPECT_EQ(std::get<Periodic>(beyond.verdict).passes, 2);
    EXPECT_TRUE(chatters(beyond.verdict));
    EXPECT_EQ(walls_repeat(beyond), teeth == 2);
    p.setup.cut.a_p = 0.8 * limit->depth;  // nearer, both motions are stable
    if (teeth == 2) {
      EXPECT_FALSE(chatters(steady_state(p).verdict));
    }
  }
}

TEST(SteadyState, DoesNotDependOnTheTurnsAskedFor) {
  for (const double depth : {0.2, 0.5}) {
    MotionProblem p = benchmark(depth);
    const SteadyState usual = steady_state(p);
    for (const int turns : {1, 2, 5}) {
      p.revolutions = turns;
      const SteadyState steady = steady_state(p);
      EXPECT_EQ(name_of(steady.verdict), name_of(usual.verdict)) << turns;
      EXPECT_EQ(steady.motion.turns_done, usual.motion.turns_done) << turns;
      EXPECT_EQ(chatters(steady.verdict), chatters(usual.verdict)) << turns;
    }
  }
}

/// Nearly a period doubling: the transient goes to and fro from tooth to tooth.
TEST(SteadyState, ATransientThatGoesToAndFroIsNoPeriodOfItsOwn) {
  MotionProblem p = benchmark(1.7);
  p.setup.cut.engagement = geometry::UpMilling{0.6 * unit::mm};
  p.setup.cut.Omega = 19500 * unit::rpm;
  for (const int turns : {8, 10, 14, 20}) {
    p.revolutions = turns;
    const SteadyState steady = steady_state(p);
    EXPECT_FALSE(chatters(steady.verdict)) << turns;
  }
}

TEST(PeriodText, SaysTeethAndTurns) {
  EXPECT_EQ(period_text({1, 1}, 4), "with every tooth");
  EXPECT_EQ(period_text({2, 1}, 4), "every 2 teeth");
  EXPECT_EQ(period_text({4, 4}, 4), "with every turn");
  EXPECT_EQ(period_text({6, 1}, 4), "every 6 teeth");
  EXPECT_EQ(period_text({8, 4}, 4), "every 2 turns");
  EXPECT_EQ(period_text({1, 1}, 1), "with every tooth");
  EXPECT_EQ(period_text({3, 1}, 1), "every 3 turns");
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

}  // namespace trochoid::dynamics::steady_state_test
