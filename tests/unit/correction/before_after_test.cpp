#include "paper_case.h"

#include <trochoid/correction/before_after.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace trochoid::correction::before_after_test {

namespace {

BeforeAfter before_after(const Setting& setting, const PeriodicMotion& command) {
  return {.before = moved_cut(setting, Harmonics{}),
          .after = moved_cut(setting, command)};
}

}  // namespace

TEST(BeforeAfter, TheCommandMakesThePeaksEqual) {
  const Setting s = known_setting(moving_case(27.8e-6), {}, RunoutEstimate::known);
  const Plan plan = plan_correction(s, {.strategy = Method::lead});
  const BeforeAfter cuts = before_after(s, plan.command.wave);
  EXPECT_EQ(chatter_in(cuts.before, "before"), "");
  EXPECT_EQ(dynamics::name_of(cuts.before.verdict), "periodic");
  EXPECT_EQ(dynamics::name_of(cuts.after.verdict), "periodic");
  EXPECT_NEAR(dynamics::peak_difference(cuts.before.motion), 0.388, 0.002);
  EXPECT_LT(dynamics::peak_difference(cuts.after.motion), 0.002);
  ASSERT_TRUE(reduction(cuts));
  EXPECT_GT(*reduction(cuts), 0.99);
  const double wanted = range_of(plan.motion).peak_to_peak();
  const double deviation = table_deviation(s, plan, cuts.after);
  EXPECT_LT(deviation, 0.1 * wanted);
  EXPECT_GT(table_deviation(s, plan, cuts.before), 0.4 * wanted) << "it stands still";
}

/// The wall is the longer flute's, f^2/(8 R) deep, with the command as without.
TEST(BeforeAfter, TheWallStaysTheLongerFlutes) {
  const Setting s = known_setting(moving_case(27.8e-6), {}, RunoutEstimate::known);
  const BeforeAfter cuts =
      before_after(s, plan_correction(s, {.peak_to_peak = 26e-6}).command.wave);
  for (const MovedCut* cut : {&cuts.before, &cuts.after}) {
    ASSERT_EQ(cut->walls.size(), 2U) << "a slot has two walls";
    EXPECT_FALSE(cut->walls[0].exit);
    EXPECT_TRUE(cut->walls[1].exit);
    const WallMarks& marks = cut->walls[1].marks;
    EXPECT_NEAR(marks.peak_to_valley, 100e-6 * 100e-6 / (8 * 4e-3), 5e-9);
    EXPECT_NEAR(marks.share.at(0), 1.0, 1e-6);
  }
}

TEST(BeforeAfter, APartialCutHasOneWall) {
  MovingCut cut = moving_case(10e-6);
  cut.setup.cut.engagement = geometry::UpMilling{2e-3};
  const Setting s = known_setting(cut, {}, RunoutEstimate::known);
  const MovedCut moved = moved_cut(s, Harmonics{});
  ASSERT_EQ(moved.walls.size(), 1U);
  EXPECT_FALSE(moved.walls[0].exit);
}

TEST(BeforeAfter, SaysThatACutChatters) {
  MovingCut soft = moving_case(27.8e-6);
  for (dynamics::ChipMode& mode : soft.tool) {
    mode.stiffness /= 16;
    mode.mass /= 16;
  }
  soft.setup.cut.a_p = 3e-3;
  const Setting s = known_setting(soft, {}, RunoutEstimate::known);
  const MovedCut moved = moved_cut(s, Harmonics{});
  EXPECT_TRUE(dynamics::chatters(moved.verdict));
  EXPECT_TRUE(moved.walls.empty());
}

TEST(ChatterIn, SaysHowFarItWent) {
  MovedCut cut{.verdict = dynamics::Bounded{.fades = true}};
  EXPECT_EQ(chatter_in(cut, "before"), "") << "transients are no chatter";
  cut.verdict = dynamics::Bounded{};
  cut.motion.flutes = {{.peak_x = 30, .peak_y = 40}, {}};
  cut.motion.last_change = 8;
  EXPECT_EQ(chatter_in(cut, "before"),
            "chatter before the correction: the force still changes by 8 of 40 N from "
            "turn to turn; there are no steady peaks to make equal");
  cut.verdict = dynamics::Bounded{.amplitude = {12e-6, 3e-6}, .turns = 32};
  EXPECT_EQ(
      chatter_in(cut, "before"),
      "chatter before the correction: the motion does not repeat; over the last 32 "
      "turns it stays within 12 um of its middle along x and 3 um along y; there "
      "are no steady peaks to make equal");
  cut.verdict = dynamics::Periodic{.passes = 4, .passes_of_cut = 2};
  EXPECT_EQ(
      chatter_in(cut, "before"),
      "chatter before the correction: the motion repeats every 2 turns only; there "
      "are no steady peaks to make equal");
  cut.verdict = dynamics::Growing{};
  cut.motion.finite = false;
  cut.motion.turns_done = 3;
  EXPECT_EQ(chatter_in(cut, "after"),
            "chatter after the correction: after 3 turns the tool is more than 100 mm "
            "from where it would rest: far out of the cut");
}

TEST(Reduction, IsOfADifferenceThatThereWas) {
  BeforeAfter cuts;
  cuts.before.motion.flutes = {{.peak_y = 100}, {.peak_y = 60}};
  cuts.after.motion.flutes = {{.peak_y = 80}, {.peak_y = 72}};
  EXPECT_NEAR(reduction(cuts).value_or(0), 0.75, 1e-12);
  cuts.before.motion.flutes[1].peak_y = 100;
  EXPECT_FALSE(reduction(cuts));
}

}  // namespace trochoid::correction::before_after_test
