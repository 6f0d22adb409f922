// The fault table of docs/guide/controller.md, row by row.
#include "spindle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace trochoid::controller_fault_test {

using tests::Bench;
using tests::sine_config;
using Input = TrochoidControllerInput;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double turn = 1.0 / 20.0;  // [s]

/// Runs well, then every input is spoilt: time until the fault is seen [s].
double time_to_fault(Bench& bench, int expected,
                     const std::function<void(Input&)>& spoil) {
  EXPECT_LT(bench.until(TROCHOID_RUNNING), 1.0);
  bench.run(0.1037);  // not at a special angle
  const double start = bench.time;
  while (bench.time - start < 5.0) {
    Input in = bench.spindle.next();
    spoil(in);
    if (bench.give(in).state == TROCHOID_FAULT) {
      EXPECT_EQ(bench.last.fault, expected) << trochoid_problem_name(bench.last.fault);
      return bench.time - start;
    }
  }
  ADD_FAILURE() << "no fault";
  return 5.0;
}

/// The ramp ends at mid-stroke within ramp_s, and stays although all is well again.
void expect_ramp_and_rest(Bench& bench) {
  EXPECT_LE(bench.until_rest(), bench.controller.config.ramp_s + 2e-3);
  bench.run(1.0);
  EXPECT_EQ(bench.last.state, TROCHOID_FAULT);
  EXPECT_EQ(bench.last.command_m, bench.controller.middle_m);
}

TEST(ControllerFault, LostIndex) {  // [L-4]
  Bench bench(sine_config());
  const double time =
      time_to_fault(bench, TROCHOID_INDEX_LOST, [](Input& in) { in.index = 0; });
  EXPECT_LE(time, 1.5 * turn + 2e-3);
  EXPECT_GE(time, 0.5 * turn);
  expect_ramp_and_rest(bench);
}

TEST(ControllerFault, Overspeed) {
  auto config = sine_config();
  config.max_speed_rps = 21.0;
  Bench bench(config);
  const double time = time_to_fault(bench, TROCHOID_OVERSPEED,
                                    [&](Input&) { bench.spindle.speed = 24.0; });
  EXPECT_LE(time, 0.25 * turn);
  bench.spindle.speed = 20.0;
  expect_ramp_and_rest(bench);
}

TEST(ControllerFault, Underspeed) {
  auto config = sine_config();
  config.min_speed_rps = 15.0;
  config.speed_change = 0.5;
  Bench bench(config);
  const double time = time_to_fault(bench, TROCHOID_UNDERSPEED,
                                    [&](Input&) { bench.spindle.speed = 5.0; });
  EXPECT_LE(time, 0.25 * turn);
  bench.spindle.speed = 20.0;
  expect_ramp_and_rest(bench);
}

TEST(ControllerFault, SpindleTurnsBack) {
  auto config = sine_config();
  config.speed_change = 1.0;
  Bench bench(config);
  const double time = time_to_fault(bench, TROCHOID_UNDERSPEED,
                                    [&](Input&) { bench.spindle.speed = -20.0; });
  EXPECT_LE(time, 0.5 * turn);
  bench.spindle.speed = 20.0;
  expect_ramp_and_rest(bench);
}

TEST(ControllerFault, SpeedChange) {
  Bench bench(sine_config());
  const double time = time_to_fault(bench, TROCHOID_SPEED_CHANGED,
                                    [&](Input&) { bench.spindle.speed = 16.0; });
  EXPECT_LE(time, 0.25 * turn);
  bench.spindle.speed = 20.0;
  expect_ramp_and_rest(bench);
}

TEST(ControllerFault, SpeedReadsZeroWhileThePositionMoves) {
  Bench bench(sine_config());
  const double time = time_to_fault(bench, TROCHOID_SPEED_CHANGED,
                                    [](Input& in) { in.speed_rps = 0.0; });
  EXPECT_LE(time, 0.25 * turn);
  expect_ramp_and_rest(bench);
}

TEST(ControllerFault, FrozenCounter) {  // [L-4]
  Bench bench(sine_config());
  double frozen = nan;
  const double time = time_to_fault(bench, TROCHOID_BAD_POSITION, [&](Input& in) {
    frozen = std::isnan(frozen) ? in.position_rev : frozen;
    in.position_rev = frozen;
    in.index = 0;
  });
  EXPECT_NEAR(time, 0.1 * turn, 2e-3);
  expect_ramp_and_rest(bench);
}

TEST(ControllerFault, PositionJumps) {  // [L-4]
  for (const double jump : {0.11, -0.11, 0.5, 1e6 + 0.3}) {
    Bench bench(sine_config());
    const double time = time_to_fault(bench, TROCHOID_BAD_POSITION, [&](Input& in) {
      in.position_rev += jump;
      in.index = 0;
    });
    EXPECT_NEAR(time, 1e-3, 1e-9);
    expect_ramp_and_rest(bench);
  }
}

TEST(ControllerFault, LostCounts) {
  Bench bench(sine_config());
  const double start = bench.spindle.turns;
  const double time = time_to_fault(bench, TROCHOID_BAD_POSITION, [&](Input& in) {
    in.position_rev = start + 0.85 * (in.position_rev - start);
    in.index_position_rev = start + 0.85 * (in.index_position_rev - start);
  });
  EXPECT_LE(time, 1.0 * turn);
  expect_ramp_and_rest(bench);
}

TEST(ControllerFault, PulseOutOfPlace) {
  // The pulse of a cable that picks up noise, after three quarters of a turn.
  Bench bench(sine_config());
  bench.until(TROCHOID_RUNNING);
  while (bench.last.angle_rev < 0.7 || bench.last.angle_rev > 0.8) {
    bench.step();
  }
  Input in = bench.spindle.next();
  in.index = 1;
  in.index_position_rev = in.position_rev;
  EXPECT_EQ(bench.give(in).fault, TROCHOID_BAD_POSITION);
  expect_ramp_and_rest(bench);
}

TEST(ControllerFault, BouncingPulseIsPassedOver) {
  Bench bench(sine_config());
  bench.until(TROCHOID_RUNNING);
  const int turns = bench.last.turns;
  for (int i = 0; i < 1000; ++i) {
    Input in = bench.spindle.next();
    const double angle = in.position_rev - std::floor(in.position_rev);
    in.index = angle < 0.3 && (i % 2) == 0 ? 1 : in.index;
    in.index_position_rev = std::floor(in.position_rev);
    EXPECT_EQ(bench.give(in).state, TROCHOID_RUNNING);
    EXPECT_NEAR(bench.last.angle_rev, angle, 1e-9);
  }
  EXPECT_NEAR(bench.last.turns - turns, 20, 1);
}

TEST(ControllerFault, InputsThatAreNotNumbersOrAbsurd) {
  const std::vector<std::function<void(Input&)>> spoils = {
      [](Input& in) { in.position_rev = nan; },
      [](Input& in) { in.position_rev = -inf; },
      [](Input& in) { in.position_rev = 1e300; },
      [](Input& in) { in.speed_rps = nan; },
      [](Input& in) { in.speed_rps = inf; },
      [](Input& in) { in.speed_rps = 2000.0; },
      [](Input& in) { in.gain = nan; },
      [](Input& in) { in.gain = inf; },
      [](Input& in) {
        in.index = 1;
        in.index_position_rev = nan;
      },
  };
  for (const auto& spoil : spoils) {
    Bench bench(sine_config());
    EXPECT_NEAR(time_to_fault(bench, TROCHOID_BAD_INPUT, spoil), 1e-3, 1e-9);
    expect_ramp_and_rest(bench);
  }
}

TEST(ControllerFault, TimeThatDoesNotPassHoldsTheCommand) {
  for (const double dt : {0.0, -1e-3, nan, -inf}) {
    Bench bench(sine_config());
    bench.until(TROCHOID_RUNNING);
    bench.run(0.1037);
    const double held = bench.last.command_m;
    ASSERT_NE(held, bench.controller.middle_m);
    for (int i = 0; i < 10; ++i) {
      Input in = bench.spindle.next();
      in.dt_s = dt;
      EXPECT_EQ(bench.give(in).command_m, held);
      EXPECT_EQ(bench.last.fault, TROCHOID_BAD_TIME);
    }
    expect_ramp_and_rest(bench);
  }
}

TEST(ControllerFault, MissedPeriods) {
  for (const double dt : {6e-3, 1e9, inf}) {
    Bench bench(sine_config());
    EXPECT_NEAR(
        time_to_fault(bench, TROCHOID_BAD_TIME, [&](Input& in) { in.dt_s = dt; }), 1e-3,
        1e-9);
    expect_ramp_and_rest(bench);
  }
}

TEST(ControllerFault, NoInputAtAll) {
  Bench bench(sine_config());
  bench.until(TROCHOID_RUNNING);
  const double held = bench.last.command_m;
  const auto result = trochoid_controller_step(&bench.controller, nullptr);
  EXPECT_EQ(result.command_m, held);
  EXPECT_EQ(result.fault, TROCHOID_BAD_TIME);
}

TEST(ControllerFault, Inhibit) {
  Bench bench(sine_config());
  EXPECT_NEAR(
      time_to_fault(bench, TROCHOID_INHIBITED, [](Input& in) { in.inhibit = 1; }), 1e-3,
      1e-9);
  expect_ramp_and_rest(bench);
}

TEST(ControllerFault, FaultWhileFadingOutAlsoRamps) {
  Bench bench(sine_config());
  bench.until(TROCHOID_RUNNING);
  for (int i = 0; i < 50; ++i) {
    Input in = bench.spindle.next();
    in.enable = 0;
    bench.give(in);
  }
  Input in = bench.spindle.next();
  in.enable = 0;
  in.position_rev = nan;
  EXPECT_EQ(bench.give(in).state, TROCHOID_FAULT);
  // Not enabled any more: it may go on to disabled as soon as it rests.
  for (int i = 0; i < 250; ++i) {
    in = bench.spindle.next();
    in.enable = 0;
    bench.give(in);
  }
  EXPECT_EQ(bench.last.state, TROCHOID_DISABLED);
  EXPECT_EQ(bench.last.fault, TROCHOID_BAD_INPUT);
  EXPECT_EQ(bench.last.command_m, bench.controller.middle_m);
}

TEST(ControllerFault, RunsAgainAfterEnableWasOff) {
  Bench bench(sine_config());
  time_to_fault(bench, TROCHOID_INDEX_LOST, [](Input& in) { in.index = 0; });
  Input in = bench.spindle.next();
  in.enable = 0;  // for one step, while it still ramps
  bench.give(in);
  EXPECT_EQ(bench.last.state, TROCHOID_FAULT);
  EXPECT_LT(bench.until(TROCHOID_RUNNING), 0.2 + 2.0 * turn + 0.31);
  EXPECT_EQ(bench.last.fault, TROCHOID_NO_PROBLEM);
}

TEST(ControllerFault, RunsAgainAfterGoodTurnsWhereThatIsSet) {
  auto config = sine_config();
  config.recovery = TROCHOID_RECOVER_BY_TURNS;
  config.good_turns = 4;
  Bench bench(config);
  time_to_fault(bench, TROCHOID_INDEX_LOST, [](Input& in) { in.index = 0; });
  const double start = bench.time;
  EXPECT_LT(bench.until(TROCHOID_FADING_IN), 0.2 + 6.0 * turn);
  EXPECT_GT(bench.time - start, 4.0 * turn);
}

TEST(ControllerFault, NoRunWhileTheProblemStays) {
  auto config = sine_config();
  config.recovery = TROCHOID_RECOVER_BY_TURNS;
  Bench bench(config);
  time_to_fault(bench, TROCHOID_INHIBITED, [](Input& in) { in.inhibit = 1; });
  for (int i = 0; i < 3000; ++i) {
    Input in = bench.spindle.next();
    in.inhibit = 1;
    in.enable = i % 100 < 50 ? 1 : 0;
    bench.give(in);
    ASSERT_NE(bench.last.state, TROCHOID_FADING_IN);
  }
  EXPECT_EQ(bench.last.command_m, bench.controller.middle_m);
}

}  // namespace trochoid::controller_fault_test
