#include "paper_case.h"

#include <trochoid/correction/plan.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trochoid::correction::plan_test {

namespace {

const Setting& paper_setting() {
  static const Setting setting =
      known_setting(moving_case(27.8e-6), {}, RunoutEstimate::known);
  return setting;
}

/// What a plan leaves of the cut that it is for.
std::vector<Flute> flutes_with(const Plan& plan) {
  return moving_flutes(paper_setting().cut, plan.command.wave).flutes;
}

double range(const PeriodicMotion& motion) {
  return range_of(motion).peak_to_peak();
}

}  // namespace

TEST(Plan, MakesThePeaksOfTheFlutesEqual) {
  const double before =
      peak_difference(moving_flutes(paper_setting().cut, Harmonics{}).flutes);
  EXPECT_NEAR(before, 0.388, 0.002);
  for (const Method strategy : {Method::plain, Method::lead, Method::inverse}) {
    SCOPED_TRACE(name_of(strategy));
    const Plan plan = plan_correction(paper_setting(), {.strategy = strategy});
    ASSERT_TRUE(plan.ok) << plan.reason;
    EXPECT_FALSE(nothing_to_correct(paper_setting(), {.strategy = strategy}));
    EXPECT_LT(peak_difference(flutes_with(plan)), 0.002);
    EXPECT_TRUE(plan.limits.ok);
    EXPECT_FALSE(plan.learned);
  }
}

TEST(Plan, WantsNoMotionThatItsCommandDoesNotMake) {
  for (const Shape shape : {Shape::square, Shape::trapezoid, Shape::sine}) {
    SCOPED_TRACE(name_of(shape));
    const Plan plan = plan_correction(
        paper_setting(),
        {.shape = shape, .transition = 0.5, .harmonics = 1, .peak_to_peak = 22e-6});
    ASSERT_TRUE(plan.ok) << plan.reason;
    EXPECT_EQ(plan.command.n_max, 1);
    EXPECT_EQ(std::get<Harmonics>(plan.motion).c.size(), 1U);
    EXPECT_NEAR(range(plan.motion), 22e-6, 0.05e-6);
    const Setting& s = paper_setting();
    const Harmonics made =
        table_response(s.cut.plant, plan.command.wave, s.cut.setup.cut.Omega, 15);
    EXPECT_NEAR(range(made), range(plan.motion), 0.05e-6);
  }
}

TEST(Plan, SaysAtWhichSpeedTheStrokeEnds) {
  const Plan plan = plan_correction(paper_setting(), {.strategy = Method::inverse});
  const auto speed =
      std::ranges::find(plan.limits.limits, LimitKind::speed, &Limit::kind);
  ASSERT_NE(speed, plan.limits.limits.end());
  EXPECT_GT(speed->limit, paper_setting().cut.setup.cut.Omega);
  EXPECT_TRUE(speed->ok);
}

/// [diez2010]: 30 um for a runout that is read as 26 um.
TEST(Plan, TellsTheActuatorAsMuchAsThePaper) {
  const Plan plan = plan_correction(paper_setting(), {.strategy = Method::lead});
  EXPECT_NEAR(range(plan.command.wave), 30.2e-6, 0.3e-6);
  const auto& actuator = paper_setting().cut.plant.actuator;
  EXPECT_NEAR(plan.command.lead, actuator.sum, 1e-12);
}

TEST(Plan, MakesTheChipAreasEqualWhereThatIsTheTarget) {
  const Plan plan = plan_correction(
      paper_setting(), {.target = Target::chip_area, .strategy = Method::lead});
  ASSERT_TRUE(plan.ok) << plan.reason;
  const auto flutes = flutes_with(plan);
  EXPECT_LT(area_difference(flutes), 0.002);
  EXPECT_GT(peak_difference(flutes), 0.02) << "equal chips are not equal peaks";
}

TEST(Plan, HasTheMotionThatIsAskedFor) {
  const Plan plan = plan_correction(paper_setting(),
                                    {.strategy = Method::plain, .peak_to_peak = 10e-6});
  ASSERT_TRUE(plan.ok) << plan.reason;
  EXPECT_NEAR(range(plan.motion), 10e-6, 1e-12);
  EXPECT_NEAR(range(plan.command.wave), 10e-6, 1e-12);
}

/// Nothing else is known then: the peaks of the rigid cut are made equal.
TEST(Plan, OfAStaticFitIsMadeOnTheRigidCut) {
  const CorrectionOptions options{.strategy = Method::lead,
                                  .estimate = RunoutEstimate::static_fit};
  const Setting s = known_setting(paper_setting().cut, {}, RunoutEstimate::static_fit);
  const Plan plan = plan_correction(s, options);
  ASSERT_TRUE(plan.ok) << plan.reason;
  EXPECT_LT(peak_difference(designed_cut(s).peaks(plan.motion)), 0.002);
  EXPECT_GT(peak_difference(flutes_with(plan)), 0.02);
}

TEST(Plan, LearnsWhatTheModelOfThePlantLeaves) {
  const Plan plan = plan_correction(
      paper_setting(), {.strategy = Method::learning, .peak_to_peak = 26e-6});
  ASSERT_TRUE(plan.ok) << plan.reason;
  ASSERT_TRUE(plan.learned);
  ASSERT_GT(plan.learned->error.size(), 1U);
  EXPECT_LT(plan.learned->error.back(), 0.1 * plan.learned->error.front());
}

TEST(Plan, HoldsNoMoreHarmonicsThanTheActuatorFollows) {
  Setting slow = paper_setting();
  slow.limits.most_frequency = 70.0;  // 20 Hz a turn
  const CorrectionOptions options{.shape = Shape::harmonics, .peak_to_peak = 26e-6};
  const Plan plan = plan_correction(slow, options);
  ASSERT_TRUE(plan.ok) << plan.reason;
  EXPECT_EQ(plan.command.n_max, 3);
  slow.limits.most_frequency = 45.0;
  EXPECT_EQ(plan_correction(slow, options).command.n_max, 1);
}

TEST(Plan, StandsAboutTheMiddleOfTheStroke) {
  const Plan plan = plan_correction(paper_setting(), {.peak_to_peak = 26e-6});
  const auto command = command_over_turn(plan, 720);
  const auto [low, high] = std::minmax_element(command.begin(), command.end());
  ASSERT_EQ(command.size(), 720U);
  EXPECT_NEAR((*low + *high) / 2, 30e-6, 0.01e-6);
  EXPECT_NEAR(*high - *low, range(plan.command.wave), 0.01e-6);
  const auto motion = motion_over_turn(plan, 4);
  EXPECT_NEAR(motion[1] - motion[0],
              place_at(plan.motion, unit::turn / 4) - place_at(plan.motion, 0), 1e-12);
}

TEST(Plan, SaysWhatIsBeyondALimitAndGoesOn) {
  Setting narrow = paper_setting();
  narrow.limits.stroke_high = 20e-6;
  const Plan plan = plan_correction(narrow, {.strategy = Method::lead});
  EXPECT_TRUE(plan.ok);
  EXPECT_FALSE(plan.limits.ok);
}

TEST(Plan, SaysThatThereIsNothingToCorrect) {
  const Setting s = known_setting(moving_case(0.0), {}, RunoutEstimate::known);
  EXPECT_TRUE(nothing_to_correct(s, {}));
  const Plan plan = plan_correction(s, {});
  EXPECT_FALSE(plan.ok);
  EXPECT_EQ(plan.reason, "the teeth stand out alike: there is nothing to correct");
}

TEST(Plan, SaysWhyThereIsNoCommand) {
  const Plan plan =
      plan_correction(paper_setting(), {.strategy = Method::inverse_in_time,
                                        .shape = Shape::square,
                                        .peak_to_peak = 26e-6});
  EXPECT_FALSE(plan.ok) << "a jump has no derivative";
  EXPECT_FALSE(plan.reason.empty());
  EXPECT_EQ(plan.reason, plan.command.reason);
}

TEST(CommandOptionsOf, ARateIsATimeBetweenSamples) {
  EXPECT_EQ(command_options({}).sample_time, 0.0);
  EXPECT_EQ(command_options({}).n_max, 9);
  EXPECT_DOUBLE_EQ(command_options({.sample_rate = 500}).sample_time, 0.002);
}

}  // namespace trochoid::correction::plan_test
