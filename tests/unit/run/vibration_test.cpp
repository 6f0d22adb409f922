#include "../cases/case_text.h"
#include "slot_case.h"

#include <trochoid/base/units.h>
#include <trochoid/run/commands.h>
#include <trochoid/run/modes.h>
#include <trochoid/run/problems.h>
#include <trochoid/run/vibration.h>

#include <gtest/gtest.h>

#include <cmath>

namespace trochoid::run::vibration_test {

using cases::Command;
using cases::test::CaseFolder;

const std::string benchmark =
    small_cut("engagement = \"slot\"", "0.2", 5000) + one_mode;
const std::string along_z = R"(
[[mode]]
body = "tool"
axis = "z"
mass_kg = 0.1
frequency_Hz = 500
damping_ratio = 0.01
)";
const std::string driven_table = R"(
[[mode]]
body = "table"
axis = "x"
mass_kg = 0.194
stiffness_N_per_m = 1.7e7
damping_Ns_per_m = 77.3
[actuator]
time_constants_s = [0.001, 0.001]
)";

std::string deeper(std::string text, const std::string& depth) {
  const std::string key = "axial_depth_mm = 0.2";
  return text.replace(text.find(key), key.size(), "axial_depth_mm = " + depth);
}

std::vector<std::string> codes(const std::vector<base::Warning>& warnings) {
  std::vector<std::string> all;
  for (const base::Warning& warning : warnings) {
    all.push_back(warning.code);
  }
  return all;
}

class Vibration : public testing::Test {
 protected:
  [[nodiscard]] cases::Case read(const std::string& text, Command command) const {
    return folder_.read(text, command);
  }
  CaseFolder folder_;
};

TEST_F(Vibration, AProblemOfStabilityIsTheCase) {
  const auto p = stability_problem(
      read(benchmark + "[stability]\nspindle_rpm = [4000, 6000, 3]\n"
                       "axial_depth_mm = [0.1, 0.3, 2]\nmargin = 0.02\n",
           Command::stability));
  EXPECT_EQ(p.system.modes.size(), 1U);
  ASSERT_EQ(p.spindle_speeds.size(), 3U);
  EXPECT_NEAR(p.spindle_speeds[1], 5000 * unit::rpm, 1e-9);
  EXPECT_EQ(p.depths.size(), 2U);
  EXPECT_EQ(p.options.margin, 0.02);
  EXPECT_EQ(p.options.chip_floor, 2e-6);
}

TEST_F(Vibration, AProblemOfMotionIsTheCase) {
  const auto p = motion_problem(
      read(benchmark + driven_table +
               "[command]\npeak_to_peak_um = 20\n[sampling]\nrevolutions = 5\n",
           Command::dynamics));
  ASSERT_TRUE(p.drive);
  EXPECT_EQ(p.drive->mode, 1U) << "the table is the second mode";
  EXPECT_EQ(p.revolutions, 5);
  EXPECT_EQ(p.kept, 2);
  ASSERT_TRUE(p.command);
  EXPECT_NEAR(p.command(0.003), 10e-6, 1e-12);  // a quarter of a turn
  EXPECT_FALSE(motion_problem(read(benchmark, Command::dynamics)).command);
}

TEST_F(Vibration, StabilityTellsOfItsCase) {
  const auto r = stability(read(benchmark + along_z +
                                    "[stability]\n"
                                    "spindle_rpm = [4900, 5000, 2]\n"
                                    "axial_depth_mm = [0.2, 1, 2]\n",
                                Command::stability),
                           {});
  EXPECT_TRUE(r.heading.ok);
  EXPECT_TRUE(
      r.heading.message.starts_with("Stable to 0.409 mm at 5000 rpm: the cut "
                                    "of 0.2 mm lies 51 % below. "))
      << r.heading.message;
  EXPECT_EQ(codes(r.heading.warnings),
            (std::vector<std::string>{"mode_along_z", "one_direction"}));
  EXPECT_NEAR(std::abs(r.stability.multiplier.value), 0.8197427843, 1e-5);
  EXPECT_EQ(r.stability.lobes.multiplier.size(), 4U);
}

TEST_F(Vibration, WithoutTimeStabilityAnswersTheCaseAlone) {
  const base::Stop at_once{base::Stop::Clock::now()};
  const auto given = read(benchmark +
                              "[stability]\nspindle_rpm = [4900, 5000, 2]\n"
                              "axial_depth_mm = [0.2, 1, 2]\n",
                          Command::stability);
  const auto r = stability(given, {}, at_once);
  EXPECT_TRUE(r.heading.ok);
  EXPECT_TRUE(r.heading.message.starts_with("Stable to 0.409 mm at 5000 rpm: "))
      << r.heading.message;
  EXPECT_EQ(r.heading.message.find("within 30 %"), std::string::npos);
  EXPECT_EQ(codes(r.heading.warnings),
            (std::vector<std::string>{"time_limit", "one_direction"}));
  EXPECT_FALSE(r.stability.whole);
  EXPECT_TRUE(r.stability.lobes.Omega.empty());
  EXPECT_EQ(results::find(results::answer_of(r).result, "better_speed"), nullptr);
  const auto whole = stability(given, {});
  EXPECT_TRUE(whole.stability.whole);
  EXPECT_NE(results::find(results::answer_of(whole).result, "better_speed"), nullptr);
}

TEST_F(Vibration, AStableCutReachesASteadyState) {
  const auto r = run::dynamics(read(benchmark, Command::dynamics), {});
  EXPECT_TRUE(r.heading.ok);
  ASSERT_TRUE(r.steady);
  EXPECT_EQ(dynamics::name_of(r.steady->verdict), "periodic");
  EXPECT_NEAR(*r.linear_growth, std::pow(0.8197427843, 2), 1e-5);
  EXPECT_EQ(r.walls.size(), 2U) << "a slot has two walls";
  EXPECT_NE(r.heading.message.find("; the wall is off by less than 0.05 um."),
            std::string::npos)
      << r.heading.message;
  EXPECT_NEAR(r.entry.at(1), unit::turn / 2, 1e-12);
  EXPECT_EQ(r.steps_per_tooth, 1000);
}

TEST_F(Vibration, AnUnstableCutChattersWithItsAmplitudes) {
  const auto r = run::dynamics(read(deeper(benchmark, "0.5"), Command::dynamics), {});
  EXPECT_TRUE(r.heading.ok);
  EXPECT_TRUE(r.heading.message.starts_with(
      "After " + std::to_string(r.steady->motion.turns_done) +
      " turns the cut chatters: the motion stays bounded and does not repeat itself. The "
      "force in the plane of the table reaches "))
      << r.heading.message;
  ASSERT_EQ(codes(r.heading.warnings), std::vector<std::string>{"chatter"});
  const std::string& said = r.heading.warnings[0].message;
  EXPECT_EQ(
      said.find("Chatter: a small vibration grows to 1.153 of itself in each turn; "
                "it stays within "),
      0U)
      << said;
  EXPECT_NE(said.find(" Hz"), std::string::npos) << said;
  EXPECT_TRUE(r.walls.empty());
}

TEST_F(Vibration, WhatIsIgnoredIsSaid) {
  for (const std::string key : {"start_deg = 10", "angles_deg = [1, 2]"}) {
    const auto r = run::dynamics(
        read(benchmark + "[sampling]\n" + key + "\n", Command::dynamics), {});
    ASSERT_EQ(codes(r.heading.warnings), std::vector<std::string>{"sampling_ignored"});
    EXPECT_EQ(r.heading.warnings[0].message.find("[sampling] " + key.substr(0, 6)), 0U);
  }
}

TEST_F(Vibration, ADiagramOfOnePointIsOne) {
  const auto r =
      stability(read(benchmark + "[stability]\nspindle_rpm = [5000, 5000, 1]\n"
                                 "axial_depth_mm = [0.2, 0.2, 1]\n",
                     Command::stability),
                {});
  ASSERT_EQ(r.stability.lobes.multiplier.size(), 1U);
  EXPECT_NEAR(std::abs(r.stability.lobes.multiplier[0]), 0.8197427843, 1e-4);
  EXPECT_TRUE(r.stability.limit_curve.empty());
}

TEST_F(Vibration, AFastModeIsRefusedBeforeTheWork) {
  const std::string fast =
      "[[mode]]\nbody = \"tool\"\naxis = \"y\"\nmass_kg = 2.6e-3\n"
      "stiffness_N_per_m = 1e9\ndamping_ratio = 0.01\n";
  const std::string slow = small_cut("engagement = \"slot\"", "0.2", 5) + one_mode;
  const auto r = run::dynamics(read(slow + fast, Command::dynamics), {});
  EXPECT_FALSE(r.heading.ok);
  EXPECT_FALSE(r.steady);
  EXPECT_NE(r.heading.message.find("leave out modes far above"), std::string::npos);
}

TEST_F(Vibration, ModesComeFromAResponse) {
  std::string rows = "freq_Hz,re_m/N,im_m/N\n";
  for (int f = 500; f < 3000; f += 10) {
    const double w = f * unit::Hz;
    const std::complex<double> H =
        1.0 / std::complex<double>(1.7e7 - 0.194 * w * w, 77.3 * w);
    rows += std::to_string(f) + ',' + std::to_string(1e9 * H.real()) + "e-9," +
            std::to_string(1e9 * H.imag()) + "e-9\n";
  }
  static_cast<void>(folder_.write("tip.csv", rows));
  const auto given = read("[frf]\nfile = \"tip.csv\"\nbody = \"table\"\naxis = \"y\"\n",
                          Command::modes);
  const auto r = modes(given);
  EXPECT_TRUE(r.heading.ok) << r.heading.message;
  EXPECT_EQ(
      r.heading.message,
      "1 mode: 1490 Hz (damping ratio 2.1 %). Less than 0.01 % of the power of the "
      "response stays unexplained (250 lines).");
  EXPECT_EQ(r.body, structure::ModeBody::table);
  EXPECT_EQ(r.responses.at(0).motion, structure::Axis::y);
  ASSERT_EQ(r.fit.modes.size(), 1U);
  EXPECT_NEAR(r.fit.modes[0].mass.value, 0.194, 1e-4);
}

TEST_F(Vibration, AnActuatorComesFromAStep) {
  std::string rows = "time_s,command_um,position_um\n";
  const auto actuator_of = structure::from_frequency(0.98, 140, 0.7);
  for (int i = 0; i < 1000; ++i) {
    const double t = i * 5e-5;
    const double y = 6 * structure::step_response(actuator_of, t - 0.001);
    rows += std::to_string(t) + (t >= 0.001 ? ",6," : ",0,") + std::to_string(y) + '\n';
  }
  static_cast<void>(folder_.write("step.csv", rows));
  const auto given =
      read("[step]\nfile = \"step.csv\"\nstart_s = 0.001\n", Command::actuator);
  EXPECT_EQ(given.machine.step->source.start, 0.001);
  const auto r = actuator(given);
  EXPECT_TRUE(r.heading.ok) << r.heading.message;
  EXPECT_TRUE(r.heading.message.starts_with(
      "Gain 0.98, natural frequency 140 Hz, damping ratio 0.7. The step is met to "))
      << r.heading.message;
  EXPECT_EQ(r.record.time.size(), 1000U);
  EXPECT_EQ(r.command.size(), 1000U);
  EXPECT_NEAR(r.fit.dynamics.gain, 0.98, 1e-3);
}

TEST(VibrationWarnings, OfStability) {
  dynamics::Stability s;
  s.multiplier = {.value = 0.9, .error = 1e-3};
  s.cuts = false;
  s.floor = {.at_half = 0.98, .at_twice = 1.02, .decided = false};
  EXPECT_EQ(codes(stability_warnings({}, {}, s)),
            (std::vector<std::string>{"chip_floor", "no_cut", "tolerance"}));
}

TEST(VibrationWarnings, OfMotion) {
  dynamics::SteadyState steady;
  EXPECT_TRUE(motion_warnings({}, steady, 0.9).empty());
  EXPECT_EQ(codes(motion_warnings({}, steady, 1.1)),
            std::vector<std::string>{"linear_unstable"});
  steady.verdict = dynamics::Bounded{.fades = true};
  EXPECT_EQ(codes(motion_warnings({}, steady, {})),
            std::vector<std::string>{"not_periodic"});
  steady.verdict = dynamics::Periodic{.passes = 4, .passes_of_cut = 1};
  steady.motion.flutes.resize(2);
  const auto warnings = motion_warnings({}, steady, 1.2);
  ASSERT_EQ(codes(warnings), std::vector<std::string>{"chatter"});
  EXPECT_EQ(
      warnings[0].message,
      "Chatter: a small vibration grows to 1.2 of itself in each turn; the motion "
      "repeats every 2 turns only, where the cut repeats with every tooth.");
}

TEST(VibrationWarnings, OfModes) {
  structure::FittedMode mode{.mass = {1}, .stiffness = {1}, .damping = {1, 0.2}};
  mode.lines_in_peak = 3;
  results::ModesResult r;
  r.responses.resize(1);
  r.fit = {.modes = {mode}, .responses = {{.explained = 0.9}}};
  std::vector<base::Warning> warnings;
  add_modes_warnings(r, warnings);
  EXPECT_EQ(codes(warnings),
            (std::vector<std::string>{"few_lines", "loosely_known", "poor_fit"}));
}

TEST(VibrationWarnings, OfAnActuator) {
  std::vector<base::Warning> warnings;
  structure::StepRecord record{.change = std::array{0.0010, 0.0011}};
  structure::ActuatorFit fit{
      .dynamics = {.gain = -1}, .start = 0.0012, .start_se = 1e-5};
  add_actuator_warnings(record, fit, warnings);
  EXPECT_EQ(codes(warnings),
            (std::vector<std::string>{"negative_gain", "start_differs"}));
  EXPECT_NE(warnings[1].message.find("0.1 ms later than the command shows it"),
            std::string::npos)
      << warnings[1].message;
  warnings.clear();
  record.start = 0.0012;  // it was given
  fit.dynamics.gain = 1;
  add_actuator_warnings(record, fit, warnings);
  EXPECT_TRUE(warnings.empty());
}

TEST(GrowthMessage, SaysWhatGrowsAndHowItEnds) {
  dynamics::SteadyState steady{.motion = {.turns_done = 20},
                               .verdict = dynamics::Growing{1.1}};
  EXPECT_EQ(
      growth_message(steady, std::nullopt),
      "chatter: the vibration does not die out; after 20 turns the vibration still "
      "grows, to 1.1 of itself in each turn");
  steady.motion.finite = false;
  const std::string stable = growth_message(steady, 0.9);
  EXPECT_NE(stable.find("the linearised cut is stable"), std::string::npos);
  EXPECT_NE(stable.find("after 20 turns the tool is more than 100 mm from where it "
                        "would rest"),
            std::string::npos);
}

}  // namespace trochoid::run::vibration_test
