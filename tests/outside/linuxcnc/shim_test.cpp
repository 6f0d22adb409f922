#include "shim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <string>

namespace trochoid {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string file_with(const std::string& text) {
  const std::string name =
      testing::UnitTest::GetInstance()->current_test_info()->name();
  const auto path = std::filesystem::temp_directory_path() / ("shim_" + name + ".csv");
  std::ofstream(path) << text;
  return path.string();
}

std::unique_ptr<TrochoidHal> read(const std::string& text, std::string& wrong) {
  auto hal = std::make_unique<TrochoidHal>();
  const std::string path = file_with(text);
  const char* said = trochoid_hal_read_table(hal.get(), path.c_str());
  std::filesystem::remove(path);
  wrong = said != nullptr ? said : "";
  return hal;
}

std::string problem_of(const std::string& text) {
  std::string wrong;
  read(text, wrong);
  return wrong;
}

TEST(Shim, ReadsTheColumnsItNeedsWhereverTheyStand) {
  for (const std::string text :
       {"angle_deg,command_um\n0,40\n120,10\n240,20\n", "0,40\n120,10\n240,20\n",
        "# made by hand\r\n\r\ntable_um,command_um,angle_deg\r\n1,40,0\r\n2,10,120\r\n"
        "3,20,240\r\n"}) {
    std::string wrong;
    const auto hal = read(text, wrong);
    EXPECT_EQ(wrong, "") << text;
    ASSERT_EQ(hal->hal_points, 3);
    // The middle of 10 and 40 is put at mid-stroke.
    EXPECT_DOUBLE_EQ(hal->hal_table_um[0], 15.0);
    EXPECT_DOUBLE_EQ(hal->hal_table_um[1], -15.0);
    EXPECT_DOUBLE_EQ(hal->hal_table_um[2], -5.0);
  }
}

TEST(Shim, RefusesTablesThatAreWrong) {
  EXPECT_EQ(problem_of(""), "fewer than two points");
  EXPECT_EQ(problem_of("0,1\n"), "fewer than two points");
  EXPECT_EQ(problem_of("angle,command_um\n0,1\n180,2\n"),
            "has no columns angle_deg and command_um");
  EXPECT_EQ(problem_of("0,1\n90,2\n"),
            "angles are not equally spaced from 0 to below 360 deg");
  EXPECT_EQ(problem_of("0,1\nx,2\n"),
            "angles are not equally spaced from 0 to below 360 deg");
  EXPECT_EQ(problem_of("0,1\n180,nan\n"), "a command is not a number");
  EXPECT_EQ(problem_of("0,1\n180\n"), "a command is not a number");
  std::string many;
  for (int i = 0; i < 721; ++i) {
    many += std::to_string(360.0 * i / 721) + ",1\n";
  }
  EXPECT_EQ(problem_of(many), "more than 720 points");
  TrochoidHal hal{};
  EXPECT_STREQ(trochoid_hal_read_table(&hal, "/nowhere/command.csv"),
               "cannot be opened");
}

TrochoidHalSettings settings() {
  TrochoidHalSettings s{};
  s.set_upper_um = 60.0;
  s.set_start_um = 30.0;
  s.set_slew_um_per_s = 20000.0;
  s.set_period_s = 1e-3;
  s.set_fade_s = 0.3;
  s.set_ramp_s = 0.2;
  s.set_min_rps = 1.0;
  s.set_max_rps = 100.0;
  s.set_speed_change = 0.1;
  s.set_index_turns = 1.5;
  s.set_position_tol_turns = 0.1;
  s.set_good_turns = 1.0;
  s.set_feed_um = 50.0;
  s.set_exponent = 0.3;
  s.set_least_force = 1.0;
  return s;
}

/// The component with a spindle whose counter the pulse sets to zero.
struct Machine {
  std::unique_ptr<TrochoidHal> hal;
  TrochoidHalSettings set = settings();
  TrochoidHalOut out{};
  double position = 0.3;
  double gain = 1.0;
  double force = 0.0;
  bool enable = true;
  bool learn = false;

  Machine() {
    std::string wrong;
    hal = read("0,40\n120,10\n240,20\n", wrong);
  }
  void step() {
    TrochoidHalIn in{};
    position += 0.02;
    in.in_index = position >= 1.0 ? 1 : 0;
    position -= in.in_index != 0 ? 1.0 : 0.0;
    in.in_position = position;
    in.in_speed = 20.0;
    in.in_gain = gain;
    in.in_force = force;
    in.in_learn = learn ? 1 : 0;
    in.in_dt = 1e-3;
    in.in_enable = enable ? 1 : 0;
    trochoid_hal_step(hal.get(), &set, &in, &out);
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) {
      step();
    }
  }
};

TEST(Shim, RunsTheTable) {
  Machine machine;
  machine.run(1000);
  EXPECT_EQ(machine.out.out_state, TROCHOID_RUNNING);
  double low = 100.0;
  double high = 0.0;
  for (int i = 0; i < 100; ++i) {
    machine.step();
    low = std::fmin(low, machine.out.out_command_um);
    high = std::fmax(high, machine.out.out_command_um);
  }
  EXPECT_NEAR(low, 15.0, 1.0);
  EXPECT_NEAR(high, 45.0, 1.0);
}

TEST(Shim, TakesNewSettingsOnlyAtRest) {
  Machine machine;
  machine.run(1000);
  machine.set.set_upper_um = 80.0;
  machine.run(100);
  EXPECT_DOUBLE_EQ(machine.hal->hal_controller.config.upper_m, 60e-6);
  EXPECT_EQ(machine.out.out_state, TROCHOID_RUNNING);
  machine.enable = false;
  machine.run(301);
  double before = machine.out.out_command_um;
  for (int i = 0; i < 300; ++i) {
    machine.step();
    EXPECT_LE(std::fabs(machine.out.out_command_um - before), 0.21);  // 40 um in 0.2 s
    before = machine.out.out_command_um;
  }
  EXPECT_DOUBLE_EQ(machine.hal->hal_controller.config.upper_m, 80e-6);
  EXPECT_DOUBLE_EQ(before, 40.0);
}

TEST(Shim, RefusedSettingsLeaveTheOldOnesInForce) {
  Machine machine;
  machine.run(10);
  machine.enable = false;
  machine.run(10);
  machine.set.set_slew_um_per_s = nan;
  machine.run(10);
  EXPECT_EQ(machine.out.out_refused, TROCHOID_REFUSED_SLEW);
  machine.set.set_slew_um_per_s = 20000.0;
  machine.set.set_upper_um = 20.0;  // the table needs 30
  machine.run(10);
  EXPECT_EQ(machine.out.out_refused, TROCHOID_REFUSED_WINDOW);  // it stands at 30 um
  EXPECT_DOUBLE_EQ(machine.out.out_command_um, 30.0);
  machine.enable = true;
  machine.run(1000);
  EXPECT_EQ(machine.out.out_state, TROCHOID_RUNNING);
  EXPECT_LE(machine.out.out_command_um, 60.0);
}

const std::string model_of_three =
    "flute,window_start_turns,wait_turns,cosine1_per_um,sine1_per_um,cosine2_per_um,"
    "sine2_per_um,tooth1_per_um,tooth2_per_um,tooth3_per_um\n"
    "1,0.1,2,0.05,0.01,0.02,-0.03,0.03,-0.01,-0.02\n"
    "2,0.4,2,-0.01,-0.05,0.03,0.02,-0.02,0.03,-0.01\n"
    "3,0.8,2,-0.04,0.04,-0.05,0.01,-0.01,-0.02,0.03\n";

std::string model_problem(const std::string& text) {
  const auto hal = std::make_unique<TrochoidHal>();
  const std::string path = file_with(text);
  const char* said = trochoid_hal_read_model(hal.get(), path.c_str());
  std::filesystem::remove(path);
  EXPECT_EQ(said == nullptr, hal->hal_model.teeth > 0);
  return said != nullptr ? said : "";
}

std::string without(std::string text, const std::string& part) {
  return text.replace(text.find(part), part.size(), "");
}

TEST(Shim, RefusesModelsThatAreWrong) {
  EXPECT_EQ(model_problem(model_of_three), "");
  EXPECT_EQ(
      model_problem(""),
      "has no columns window_start_turns, wait_turns, cosine1_per_um, sine1_per_um");
  EXPECT_EQ(
      model_problem(without(model_of_three, ",sine2_per_um")),
      "has no columns window_start_turns, wait_turns, cosine1_per_um, sine1_per_um");
  EXPECT_EQ(model_problem(without(model_of_three, "tooth3_per_um")),
            "has not as many columns tooth1_per_um, ... as flutes");
  const auto last = model_of_three.substr(model_of_three.find("3,0.8"));
  EXPECT_EQ(model_problem(without(model_of_three, last)),
            "has not as many columns tooth1_per_um, ... as flutes");
  std::string many = model_of_three;
  for (int i = 0; i < 6; ++i) {
    many += last;
  }
  EXPECT_EQ(model_problem(many), "has more than 8 flutes");
  for (const std::string wrong : {"x", "nan", "1e99"}) {
    std::string text = model_of_three;
    EXPECT_NE(model_problem(text.replace(text.find("-0.03"), 5, wrong)), "") << wrong;
    text = model_of_three;
    EXPECT_NE(model_problem(text.replace(text.find("0.4,2"), 5, wrong + ",2")), "");
  }
  TrochoidHal hal{};
  EXPECT_STREQ(trochoid_hal_read_model(&hal, "/nowhere/estimator.csv"),
               "cannot be opened");
}

/// Three flutes that the waves change as the model says, and a tooth that wears.
struct ThreeFlutes {
  Machine machine;
  std::array<double, 3> runout = {0.25, -0.15, -0.1};
  std::array<double, 3> peak{};

  ThreeFlutes() {
    const std::string path = file_with(model_of_three);
    EXPECT_EQ(trochoid_hal_read_model(machine.hal.get(), path.c_str()), nullptr);
    std::filesystem::remove(path);
    machine.set.set_phase_turns = 0.05;
    machine.set.set_tool_change = 0.1;
    machine.learn = true;
    machine.gain = 0.0;
  }
  void turn() {
    const TrochoidEstimatorConfig& model = machine.hal->hal_model;
    for (int i = 0; i < 50; ++i) {
      const double angle = machine.position + 0.02 + machine.set.set_phase_turns;
      const double since = angle - std::floor(angle);
      const int j = since < 0.1 || since >= 0.8 ? 2 : since < 0.4 ? 0 : 1;
      double v = runout[static_cast<std::size_t>(j)];
      for (int k = 0; k < 4; ++k) {
        const auto& waves = machine.hal->hal_controller;
        v += model.wave_model[j][k] *
             (k % 2 == 0 ? waves.cosine_m[k / 2] : waves.sine_m[k / 2]);
      }
      peak[static_cast<std::size_t>(j)] = v;
      machine.force = 100.0 * (1.0 + v);
      machine.step();
    }
  }
  [[nodiscard]] double difference() const {
    const auto [low, high] = std::ranges::minmax(peak);
    return high - low;
  }
};

TEST(Shim, LearnsWavesForThreeFlutesAndTellsWhichToothChanged) {
  ThreeFlutes cut;
  for (int i = 0; i < 60; ++i) {
    cut.turn();
  }
  EXPECT_EQ(cut.machine.out.out_state, TROCHOID_RUNNING);
  EXPECT_LT(cut.difference(), 0.01);
  EXPECT_LT(cut.machine.out.out_difference, 0.01);
  EXPECT_EQ(cut.machine.out.out_tool_events, 0);
  cut.runout[1] -= 6 * 0.03;  // what the model makes of 6 um of tooth 2
  cut.runout[0] += 6 * 0.01;
  cut.runout[2] += 6 * 0.02;
  for (int i = 0; i < 60; ++i) {
    cut.turn();
  }
  EXPECT_LT(cut.difference(), 0.01);
  EXPECT_EQ(cut.machine.out.out_tool_events, 1);
  EXPECT_EQ(cut.machine.out.out_tooth, 2);
  EXPECT_NEAR(cut.machine.out.out_tooth_change_um, -6.0, 0.5);
  cut.machine.learn = false;  // without learning there are no waves
  cut.turn();
  cut.turn();
  EXPECT_GT(cut.difference(), 0.3);
}

TEST(Shim, WithoutATableOnlyMidStrokeIsCommanded) {
  Machine machine;
  machine.hal = std::make_unique<TrochoidHal>();
  for (int i = 0; i < 1000; ++i) {
    machine.step();
    ASSERT_DOUBLE_EQ(machine.out.out_command_um, 30.0);
  }
  EXPECT_EQ(machine.out.out_state, TROCHOID_RUNNING);
}

}  // namespace

}  // namespace trochoid
