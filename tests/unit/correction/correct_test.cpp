#include "paper_case.h"

#include <trochoid/correction/correct.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace trochoid::correction::correct_test {

namespace {

CorrectionProblem paper_problem() {
  return {.cut = moving_case(27.8e-6),
          .options = {.strategy = Method::lead, .peak_to_peak = 28e-6}};
}

}  // namespace

/// [diez2010]: 38 % before, at least 86 % less after.
TEST(CorrectACut, TakesTheDifferenceOfThePeaksAway) {
  CorrectionProblem problem = paper_problem();
  problem.options.peak_to_peak.reset();
  problem.options.spindle_speeds = {1000 * unit::rpm, 2000 * unit::rpm};
  const Correction c = correct(problem);
  ASSERT_TRUE(c.ok) << c.reason;
  EXPECT_NEAR(dynamics::peak_difference(c.cuts.before.motion), 0.388, 0.002);
  EXPECT_GT(reduction(c.cuts).value_or(0), 0.99);
  EXPECT_EQ(c.speeds.Omega.size(), 2U);
  EXPECT_EQ(c.axes.most_teeth, 1);
  EXPECT_FALSE(c.controller);
}

TEST(CorrectACut, TellsWhatItDoes) {
  CorrectionProblem problem = paper_problem();
  problem.controller = LoopOptions{.fade = 0.1, .turns = 12};
  std::vector<std::string> told;
  const Correction c =
      correct(problem, [&](const std::string& what) { told.push_back(what); });
  EXPECT_EQ(told, (std::vector<std::string>{
                      "Looking for the runout", "Cutting without a command",
                      "Finding the command", "Cutting with the command",
                      "Looking at other speeds", "Running the controller"}));
  ASSERT_TRUE(c.controller);
  EXPECT_TRUE(c.controller->ok) << c.controller->reason;
  EXPECT_EQ(c.controller->turns.size(), 12U);
}

TEST(CorrectACut, FindsTheRunoutInMeasuredForces) {
  CorrectionProblem problem = paper_problem();
  problem.record = moving_flutes(problem.cut, Harmonics{}).record;
  problem.cut.setup.runout = {};
  problem.cut.law = force::Power{};
  const Correction c = correct(problem);
  ASSERT_TRUE(c.ok) << c.reason;
  EXPECT_NEAR(chip_differences(c.setting.rho)[0], 27.8e-6, 0.4e-6);
  EXPECT_TRUE(c.setting.behind);
}

/// Four teeth in a slot: two cut at once, one axis cannot serve both.
TEST(CorrectACut, TellsWhatOneAxisCannotDo) {
  CorrectionProblem problem = paper_problem();
  problem.cut.setup = slot_with({10e-6, -4e-6, 3e-6, -9e-6});
  problem.cut.setup.cut.a_p = 0.2e-3;
  const Correction c = correct(problem);
  ASSERT_TRUE(c.ok) << c.reason;
  EXPECT_EQ(c.axes.most_teeth, 2);
  EXPECT_LT(c.axes.two_axes, c.axes.one_axis);
  EXPECT_LT(c.axes.one_axis, c.axes.uncorrected);
}

TEST(CorrectACut, SaysWhereItEnds) {
  CorrectionProblem problem = paper_problem();
  problem.record = ForceRecord{};
  const Correction no_record = correct(problem);
  EXPECT_FALSE(no_record.ok);
  EXPECT_EQ(no_record.reason, no_record.setting.reason);
  EXPECT_FALSE(no_record.reason.empty());

  problem = paper_problem();
  problem.cut.setup.runout = {};
  const Correction no_runout = correct(problem);
  EXPECT_FALSE(no_runout.ok);
  EXPECT_TRUE(no_runout.setting.ok);
  EXPECT_EQ(no_runout.reason, no_runout.plan.reason);

  problem = paper_problem();
  for (dynamics::ChipMode& mode : problem.cut.tool) {
    mode.stiffness /= 16;
    mode.mass /= 16;
  }
  problem.cut.setup.cut.a_p = 3e-3;
  const Correction chatter = correct(problem);
  EXPECT_FALSE(chatter.ok);
  EXPECT_EQ(chatter.reason.find("chatter before the correction: "), 0U)
      << chatter.reason;
  EXPECT_FALSE(chatter.plan.ok) << "nothing is looked for after that";
}

TEST(CorrectACut, KeepsItsAnswerWhereTheControllerRefuses) {
  CorrectionProblem problem = paper_problem();
  problem.limits.stroke_high = 20e-6;
  problem.controller = LoopOptions{.turns = 10};
  const Correction c = correct(problem);
  EXPECT_TRUE(c.ok) << c.reason;
  ASSERT_TRUE(c.controller);
  EXPECT_FALSE(c.controller->ok);
  EXPECT_FALSE(c.plan.limits.ok);
}

}  // namespace trochoid::correction::correct_test
