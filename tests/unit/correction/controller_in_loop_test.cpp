#include "paper_case.h"

#include <trochoid/correction/controller_in_loop.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trochoid::correction::controller_in_loop_test {

namespace {

constexpr double middle = 30e-6;

struct Planned {
  Setting setting;
  Plan plan;
};

Planned planned(const MovingCut& cut, const ActuatorLimits& limits = {}) {
  Planned p{.setting = known_setting(cut, limits, RunoutEstimate::known)};
  p.plan = plan_correction(p.setting, {.strategy = Method::lead});
  return p;
}

const Planned& paper() {
  static const Planned planned_once = planned(moving_case(27.8e-6));
  return planned_once;
}

ControllerInLoop run(const LoopOptions& options) {
  return controller_in_loop(paper().setting, paper().plan, options);
}

/// Enough to enable, to fade in within two turns and to settle.
LoopOptions quick() {
  return {.fade = 0.1, .turns = 16};
}

/// Of the peaks in the last turn with the whole command.
double left(const LoopOptions& options) {
  const ControllerInLoop loop = run(options);
  EXPECT_TRUE(loop.ok) << loop.reason;
  EXPECT_EQ(loop.fault, TROCHOID_NO_PROBLEM) << trochoid_problem_name(loop.fault);
  const LoopTurn* running = last_running(loop);
  EXPECT_NE(running, nullptr);
  return running == nullptr ? 1.0 : running->difference;
}

}  // namespace

TEST(ControllerInLoop, OnlyLooksUntilItIsEnabled) {
  const ControllerInLoop loop = run(quick());
  ASSERT_TRUE(loop.ok) << loop.reason;
  ASSERT_EQ(loop.turns.size(), 16U);
  EXPECT_NEAR(loop.turns[enabling_turn - 1].difference, 0.388, 0.01);
  EXPECT_EQ(loop.turns[enabling_turn - 1].state, TROCHOID_DISABLED);
  const double enabled = enabling_turn / 20.0;  // 20 turns a second
  for (const LoopSample& sample : loop.samples) {
    if (sample.time < enabled) {
      EXPECT_NEAR(sample.command, middle, 1e-12);
    }
  }
}

TEST(ControllerInLoop, MakesThePeaksEqual) {
  const ControllerInLoop loop = run(quick());
  EXPECT_LT(left(quick()), 0.01);
  EXPECT_EQ(loop.turns.back().state, TROCHOID_RUNNING);
  EXPECT_TRUE(loop.finite);
  EXPECT_GE(loop.lowest, 0.0);
  EXPECT_LE(loop.highest, 60e-6);
  EXPECT_NEAR(loop.highest - loop.lowest,
              range_of(paper().plan.command.wave).peak_to_peak(), 0.2e-6);
  const auto equal = turns_to_equal(loop, 0.03);
  ASSERT_TRUE(equal);
  EXPECT_LE(*equal, 3);
}

/// Both make the command come at a wrong angle, and so leave a difference.
TEST(ControllerInLoop, SuffersFromFewCountsAndFromJitter) {
  const double best = left(quick());
  LoopOptions coarse = quick();
  coarse.counts = 100;
  EXPECT_GT(left(coarse), 5 * best);
  EXPECT_LT(left(coarse), 0.01);
  LoopOptions slow = quick();
  slow.rate = 200;
  LoopOptions late = slow;
  late.jitter = 0.3 / late.rate;
  EXPECT_GT(left(late), 5 * left(slow));
  EXPECT_LT(left(late), 0.1) << "yet far better than no command";
}

TEST(ControllerInLoop, SaysWhyItNeverRuns) {
  LoopOptions few = quick();
  few.counts = 60;
  const ControllerInLoop loop = run(few);
  EXPECT_EQ(last_running(loop), nullptr);
  EXPECT_EQ(loop.fault, TROCHOID_NO_PROBLEM);
  EXPECT_NE(loop.held_by, TROCHOID_NO_PROBLEM);
  EXPECT_GT(loop.held_part, 0.01);
  EXPECT_GT(loop.coarse_speed, 1.0);
}

/// The command follows the angle, not the time.
TEST(ControllerInLoop, IsNotMisledByARippleOfTheSpeed) {
  LoopOptions uneven = quick();
  uneven.speed_ripple = 0.08;
  EXPECT_LT(left(uneven), 0.001);
  const ControllerInLoop even = run(quick());
  const ControllerInLoop ripple = run(uneven);
  double most = 0.0;
  for (std::size_t i = 0; i < std::min(even.samples.size(), ripple.samples.size());
       ++i) {
    most =
        std::max(most, std::abs(even.samples[i].command - ripple.samples[i].command));
  }
  EXPECT_GT(most, 1e-6) << "at the same time it stands elsewhere";
}

/// In so few counts there is no speed that it could trust.
TEST(ControllerInLoop, WaitsWhereTheEncoderIsTooCoarse) {
  LoopOptions coarse = quick();
  coarse.counts = 24;
  const ControllerInLoop loop = run(coarse);
  ASSERT_TRUE(loop.ok) << loop.reason;
  EXPECT_EQ(last_running(loop), nullptr);
  EXPECT_EQ(loop.turns.back().state, TROCHOID_WAITING);
  EXPECT_EQ(loop.highest, loop.lowest);
  EXPECT_FALSE(turns_to_equal(loop, 0.5));
}

TEST(ControllerInLoop, JitterHasAFixedSeed) {
  LoopOptions late = quick();
  late.jitter = 1e-4;
  const ControllerInLoop a = run(late);
  const ControllerInLoop b = run(late);
  ASSERT_EQ(a.samples.size(), b.samples.size());
  EXPECT_TRUE(std::equal(a.samples.begin(), a.samples.end(), b.samples.begin(),
                         [](const LoopSample& x, const LoopSample& y) {
                           return x.time == y.time && x.command == y.command;
                         }));
  EXPECT_NE(a.samples.at(1).time, 1 / late.rate);
}

TEST(ControllerInLoop, GoesToMidStrokeWhereTheIndexIsLost) {
  LoopOptions lost = quick();
  lost.index_lost_at = 10;
  lost.turns = 16;
  const ControllerInLoop loop = run(lost);
  ASSERT_TRUE(loop.ok) << loop.reason;
  EXPECT_EQ(loop.fault, TROCHOID_INDEX_LOST);
  EXPECT_GT(loop.fault_time, 10 / 20.0);
  EXPECT_LT(loop.fault_time, 12 / 20.0);
  EXPECT_EQ(loop.turns.back().state, TROCHOID_FAULT);
  ASSERT_TRUE(loop.time_to_safe);
  EXPECT_LE(*loop.time_to_safe, lost.ramp + 1 / lost.rate);
  EXPECT_NEAR(loop.samples.back().command, middle, 1e-9);
  EXPECT_GT(loop.turns.back().difference, 0.3) << "no correction, no equal peaks";
}

TEST(ControllerInLoop, IsNotYetSafeWhereTheRunEndsBefore) {
  LoopOptions lost = quick();
  lost.index_lost_at = 10;
  lost.turns = 12;
  lost.ramp = 10.0;
  const ControllerInLoop loop = run(lost);
  EXPECT_EQ(loop.fault, TROCHOID_INDEX_LOST);
  EXPECT_FALSE(loop.time_to_safe);
}

/// The command is too small by a fifth; the forces tell.
TEST(ControllerInLoop, LearnsTheAmplitudeFromTheForces) {
  Plan small = paper().plan;
  small.command.wave = scaled(small.command.wave, 0.8);
  small.motion = scaled(small.motion, 0.8);
  LoopOptions options = quick();
  options.turns = 24;
  const auto left_with = [&](bool adapt) {
    options.adapt = adapt;
    const ControllerInLoop loop = controller_in_loop(paper().setting, small, options);
    EXPECT_TRUE(loop.ok) << loop.reason;
    const LoopTurn* running = last_running(loop);
    EXPECT_NEAR(running->gain, adapt ? 1.25 : 1.0, 0.02);
    return running->difference;
  };
  EXPECT_GT(left_with(false), 0.05);
  EXPECT_LT(left_with(true), 0.01);
}

TEST(ControllerInLoop, RefusesACommandBeyondTheStroke) {
  const Planned narrow = planned(moving_case(27.8e-6), {.stroke_high = 20e-6});
  const ControllerInLoop loop =
      controller_in_loop(narrow.setting, narrow.plan, quick());
  EXPECT_FALSE(loop.ok);
  EXPECT_EQ(loop.reason, std::string("the controller refuses its configuration: ") +
                             trochoid_refusal_reason(TROCHOID_REFUSED_STROKE));
  EXPECT_TRUE(loop.samples.empty());
}

TEST(ControllerInLoop, LearnsFromThreeFlutes) {
  MovingCut three = moving_case(0.0);
  three.setup = slot_with({10e-6, 0.0, -10e-6});
  three.setup.cut.a_p = 0.2e-3;
  const Planned p = planned(three);
  LoopOptions options = quick();
  options.adapt = true;
  options.turns = 30;
  const ControllerInLoop loop = controller_in_loop(p.setting, p.plan, options);
  ASSERT_TRUE(loop.ok) << loop.reason;
  EXPECT_GT(loop.turns[enabling_turn - 1].difference, 0.1);
  EXPECT_LT(loop.turns.back().difference, 0.03);
}

TEST(ControllerInLoop, NeedsTurnsAfterItIsEnabled) {
  EXPECT_THROW(static_cast<void>(run({.turns = enabling_turn})), std::invalid_argument);
}

TEST(LastRunning, IsTheLastTurnWithTheWholeCommand) {
  ControllerInLoop loop;
  EXPECT_EQ(last_running(loop), nullptr);
  loop.turns = {{.state = TROCHOID_RUNNING},
                {.state = TROCHOID_RUNNING},
                {.state = TROCHOID_FAULT}};
  EXPECT_EQ(last_running(loop), &loop.turns[1]);
}

TEST(TurnsToEqual, CountsTurnsOfRunningUntilTheFlutesStayEqual) {
  ControllerInLoop loop;
  loop.turns = {{.difference = 0.01, .state = TROCHOID_FADING_IN},
                {.difference = 0.02, .state = TROCHOID_RUNNING},
                {.difference = 0.05, .state = TROCHOID_RUNNING},
                {.difference = 0.02, .state = TROCHOID_RUNNING},
                {.difference = 0.01, .state = TROCHOID_RUNNING}};
  EXPECT_EQ(turns_to_equal(loop, 0.03).value_or(0), 3);
  EXPECT_FALSE(turns_to_equal(loop, 0.005));
}

namespace {

/// The paper's machine with four teeth that differ by more than 30 %.
ControllerInLoop four_flutes(bool adapt) {
  MovingCut cut = moving_case(0.0);
  cut.setup = slot_with({22e-6, 3e-6, -20e-6, -5e-6});
  cut.setup.cut.a_p = 0.3e-3;
  cut.setup.cut.f_z = 60e-6;
  const Setting s = known_setting(cut, {}, RunoutEstimate::known);
  const Plan plan = plan_correction(s, {.strategy = Method::inverse,
                                        .shape = Shape::harmonics,
                                        .harmonics = 3,
                                        .peak_to_peak = 20e-6});
  return controller_in_loop(s, plan, {.fade = 0.05, .turns = 44, .adapt = adapt});
}

}  // namespace

TEST(ControllerInLoop, RefusesToLearnFromMoreFlutesThanItHolds) {
  MovingCut nine = moving_case(0.0);
  nine.setup = slot_with({10e-6, 0, -10e-6, 0, 0, 0, 0, 0, 0});
  nine.setup.cut.a_p = 0.05e-3;
  const Setting s = known_setting(nine, {}, RunoutEstimate::known);
  const Plan plan = plan_correction(s, {.peak_to_peak = 10e-6});
  LoopOptions options = quick();
  EXPECT_TRUE(controller_in_loop(s, plan, options).ok);
  options.adapt = true;
  const ControllerInLoop loop = controller_in_loop(s, plan, options);
  EXPECT_FALSE(loop.ok);
  EXPECT_EQ(loop.reason,
            "the controller refuses its configuration: teeth 2 to 8, harmonics 1 to 8");
}

TEST(ControllerInLoop, LearnsTheWavesOfFourFlutes) {  // [L-9] [L-10] [L-11]
  const ControllerInLoop loop = four_flutes(true);
  ASSERT_TRUE(loop.ok) << loop.reason;
  EXPECT_EQ(loop.fault, TROCHOID_NO_PROBLEM) << trochoid_problem_name(loop.fault);
  EXPECT_GT(loop.turns[enabling_turn - 1].difference, 0.3);
  const LoopTurn* running = last_running(loop);
  ASSERT_NE(running, nullptr);
  EXPECT_LT(running->difference, 0.03);
  EXPECT_LE(turns_to_equal(loop, 0.03).value_or(100), 30);
  EXPECT_GT(running->wave, 1e-6);
  EXPECT_EQ(running->gain, 0.0) << "the table has no part in it";
  EXPECT_GE(loop.lowest, 0.0);
  EXPECT_LE(loop.highest, 60e-6);
}

}  // namespace trochoid::correction::controller_in_loop_test
