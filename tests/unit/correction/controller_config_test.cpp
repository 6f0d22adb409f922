#include "spindle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace trochoid::controller_config_test {

using Config = TrochoidControllerConfig;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

struct Wrong {
  int refusal;
  std::function<void(Config&)> spoil;
};

std::vector<Wrong> wrongs() {
  return {
      {TROCHOID_REFUSED_POINTS, [](Config& c) { c.points = 1; }},
      {TROCHOID_REFUSED_POINTS, [](Config& c) { c.points = 721; }},
      {TROCHOID_REFUSED_POINTS, [](Config& c) { c.points = -1; }},
      {TROCHOID_REFUSED_TABLE, [](Config& c) { c.table_m[359] = nan; }},
      {TROCHOID_REFUSED_TABLE, [](Config& c) { c.table_m[0] = -inf; }},
      {TROCHOID_REFUSED_STROKE, [](Config& c) { c.table_m[7] = 30.1e-6; }},
      {TROCHOID_REFUSED_STROKE, [](Config& c) { c.table_m[7] = -30.1e-6; }},
      {TROCHOID_REFUSED_WINDOW, [](Config& c) { c.upper_m = c.lower_m; }},
      {TROCHOID_REFUSED_WINDOW, [](Config& c) { c.lower_m = 1.0; }},
      {TROCHOID_REFUSED_WINDOW, [](Config& c) { c.lower_m = nan; }},
      {TROCHOID_REFUSED_WINDOW, [](Config& c) { c.upper_m = inf; }},
      {TROCHOID_REFUSED_WINDOW, [](Config& c) { c.start_m = 61e-6; }},
      {TROCHOID_REFUSED_WINDOW, [](Config& c) { c.start_m = nan; }},
      {TROCHOID_REFUSED_TIMES, [](Config& c) { c.period_s = 0.0; }},
      {TROCHOID_REFUSED_TIMES, [](Config& c) { c.max_step_s = 0.5e-3; }},
      {TROCHOID_REFUSED_TIMES, [](Config& c) { c.fade_s = 0.0; }},
      {TROCHOID_REFUSED_TIMES, [](Config& c) { c.ramp_s = nan; }},
      {TROCHOID_REFUSED_TIMES, [](Config& c) { c.gain_time_s = -1.0; }},
      {TROCHOID_REFUSED_LEAD, [](Config& c) { c.lead_s = -1e-6; }},
      {TROCHOID_REFUSED_LEAD, [](Config& c) { c.phase_rev = inf; }},
      {TROCHOID_REFUSED_SLEW, [](Config& c) { c.slew_m_per_s = 0.0; }},
      {TROCHOID_REFUSED_SLEW, [](Config& c) { c.slew_m_per_s = inf; }},
      {TROCHOID_REFUSED_SPEEDS, [](Config& c) { c.min_speed_rps = 0.0; }},
      {TROCHOID_REFUSED_SPEEDS, [](Config& c) { c.max_speed_rps = c.min_speed_rps; }},
      {TROCHOID_REFUSED_SPEEDS, [](Config& c) { c.speed_change = 0.0; }},
      {TROCHOID_REFUSED_SPEEDS, [](Config& c) { c.filter_rev = 0.2; }},
      {TROCHOID_REFUSED_INDEX, [](Config& c) { c.index_turns = 1.0; }},
      {TROCHOID_REFUSED_INDEX, [](Config& c) { c.position_tol_rev = 0.3; }},
      {TROCHOID_REFUSED_RECOVERY, [](Config& c) { c.recovery = 2; }},
      {TROCHOID_REFUSED_RECOVERY, [](Config& c) { c.good_turns = 0; }},
  };
}

TEST(ControllerConfig, WrongInOneWayIsRefusedForThatReason) {
  std::set<int> seen;
  for (const auto& wrong : wrongs()) {
    TrochoidController controller;
    Config config = tests::sine_config();
    ASSERT_EQ(trochoid_controller_init(&controller, &config), TROCHOID_ACCEPTED);
    wrong.spoil(config);
    EXPECT_EQ(trochoid_controller_init(&controller, &config), wrong.refusal);
    const auto in = tests::Spindle{}.next();
    EXPECT_EQ(trochoid_controller_step(&controller, &in).state, TROCHOID_NOT_READY);
    seen.insert(wrong.refusal);
  }
  EXPECT_EQ(seen.size(), 10U);  // every reason but a null pointer
}

TEST(ControllerConfig, NullIsRefused) {
  TrochoidController controller;
  Config config = tests::sine_config();
  EXPECT_EQ(trochoid_controller_init(nullptr, &config), TROCHOID_REFUSED_POINTER);
  EXPECT_EQ(trochoid_controller_init(&controller, nullptr), TROCHOID_REFUSED_POINTER);
  const auto in = tests::Spindle{}.next();
  EXPECT_EQ(trochoid_controller_step(&controller, &in).state, TROCHOID_NOT_READY);
  trochoid_controller_defaults(nullptr);
}

TEST(ControllerConfig, DefaultsAreAccepted) {
  TrochoidController controller;
  Config config;
  trochoid_controller_defaults(&config);
  EXPECT_EQ(trochoid_controller_init(&controller, &config), TROCHOID_ACCEPTED);
}

TEST(ControllerConfig, EverythingHasAName) {
  std::set<std::string> names;
  for (int i = 0; i <= TROCHOID_NOT_READY; ++i) {
    names.insert(trochoid_state_name(i));
  }
  EXPECT_EQ(names.size(), 7U);
  names.clear();
  for (int i = 0; i <= TROCHOID_SPEED_CHANGED; ++i) {
    names.insert(trochoid_problem_name(i));
  }
  EXPECT_EQ(names.size(), 9U);
  names.clear();
  for (int i = 0; i <= TROCHOID_REFUSED_RECOVERY; ++i) {
    names.insert(trochoid_refusal_reason(i));
  }
  EXPECT_EQ(names.size(), 12U);
  EXPECT_STREQ(trochoid_state_name(-5), "not ready");
  EXPECT_STREQ(trochoid_problem_name(99), "unknown");
  EXPECT_STREQ(trochoid_refusal_reason(99), "unknown");
}

}  // namespace trochoid::controller_config_test
