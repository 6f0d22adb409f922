// Controller and estimator on the whole dynamic model: tool, table and actuator move.
#include <trochoid/correction/controller.h>
#include <trochoid/correction/online.h>
#include <trochoid/dynamics/motion.h>

#include "spindle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace trochoid::controlled_motion_test {

constexpr double turn = 2 * std::numbers::pi;
constexpr double rps = 20.0;

/// The paper's case with the assumed law: 8 mm, two teeth, 26 um apart, 1200 rpm.
dynamics::MotionProblem paper_case() {
  dynamics::MotionProblem p;
  p.setup.cutter = {.profile = geometry::cylinder(8e-3),
                    .pitch = geometry::equal_pitch(2),
                    .lag_diameter = 8e-3};
  p.setup.runout.radial_offsets = {13e-6, -13e-6};
  p.setup.cut = {geometry::Slot{}, 1e-3, 0.05e-3, rps * turn};
  p.setup.chip.model = chip::Model::radial;
  p.law = force::Power{
      .K_t1 = 166.718603e6, .K_r1 = 58.35151106e6, .m_t = 0.598, .m_r = 0.598};
  p.system.modes = {{0.0324228, 25.4648, 8e6, 1, 0},
                    {0.0324228, 25.4648, 8e6, 0, 1},
                    {0.194, 77.3, 1.7e7, -1, 0}};
  p.drive = dynamics::Drive{
      2,     1 / 0.99536, 2.2679e-3 / 0.99536, 1.1303e-3 * 1.1376e-3 / 0.99536,
      1.7e7, 77.3};
  p.grid.steps_per_tooth = 500;
  return p;
}

/// Peak of each flute, turn by turn, and the gain.
struct Record {
  std::vector<std::array<double, 2>> peaks;
  std::vector<double> gain;
  double difference(std::size_t i) const {
    return std::fabs(peaks[i][0] - peaks[i][1]) / std::fmax(peaks[i][0], peaks[i][1]);
  }
};

/// The controller samples every millisecond; the command stands in between. The
/// middle of the stroke is left out: the model begins at rest there.
Record controlled(const TrochoidControllerConfig& config,
                  const TrochoidOnlineConfig& learning, int turns) {
  TrochoidController controller;
  TrochoidOnline online;
  EXPECT_EQ(trochoid_controller_init(&controller, &config), TROCHOID_ACCEPTED);
  EXPECT_EQ(trochoid_online_init(&online, &learning), TROCHOID_ONLINE_ACCEPTED);
  TrochoidOnlineResult learnt{.gain = learning.gain};
  TrochoidControllerResult last{};
  Record record;
  long sample = 0;
  const auto tick = [&] {
    const double position = rps * static_cast<double>(sample) * config.period_s;
    TrochoidControllerInput in{};
    in.position_rev = position;
    in.index_position_rev = std::floor(position);
    in.index = std::floor(position) != std::floor(position - rps * config.period_s);
    in.speed_rps = rps;
    in.gain = learnt.gain;
    in.dt_s = config.period_s;
    in.enable = 1;
    last = trochoid_controller_step(&controller, &in);
    ++sample;
  };
  auto problem = paper_case();
  problem.revolutions = turns;
  problem.command = [&](double t) {
    while (static_cast<double>(sample) * config.period_s <= t) {
      tick();
    }
    return last.command_m - controller.middle_m;
  };
  problem.observe = [&](double t, const std::array<double, 3>& force, double) {
    const double angle = rps * t;
    const auto revolution = static_cast<std::size_t>(angle + 1e-9);
    learnt = trochoid_online_sample(&online, angle, force[1],
                                    last.state == TROCHOID_RUNNING);
    record.peaks.resize(revolution + 1);
    record.gain.resize(revolution + 1, learnt.gain);
    double& peak =
        record.peaks[revolution]
                    [angle + 1e-9 < static_cast<double>(revolution) + 0.5 ? 0 : 1];
    peak = std::fmax(peak, std::fabs(force[1]));
  };
  EXPECT_TRUE(dynamics::motion(problem).finite);
  return record;
}

TrochoidControllerConfig sine(double amplitude) {
  auto config = tests::sine_config(amplitude);
  config.lead_s = 2.268e-3;
  return config;
}

TrochoidOnlineConfig learning() {
  TrochoidOnlineConfig c;
  trochoid_online_defaults(&c);
  c.difference_m = 20e-6;
  c.gain_high = 3.0;
  c.gain_step = 3.0;
  c.exponent = 0.598;
  return c;
}

/// Fading in takes seven turns after two turns of waiting.
constexpr std::size_t running_from = 9;

TEST(ControlledMotion, KnownCommandMakesTheFlutesEqual) {  // [L-1]
  auto fixed = learning();
  fixed.gain = 1.0;
  fixed.deadband = 0.99;  // never learns
  const auto record = controlled(sine(14.5e-6), fixed, 16);
  EXPECT_NEAR(record.difference(0), 0.364, 0.01);
  // 86 % less, as the paper reports, by 29 um peak to peak.
  EXPECT_LT(record.difference(15), 0.14 * record.difference(0));
  EXPECT_EQ(record.gain.back(), 1.0);
}

TEST(ControlledMotion, LearnsTheRunoutInFiveTurns) {  // [L-5] [L-6]
  const auto record = controlled(sine(10e-6), learning(), 24);
  for (std::size_t i = 0; i < running_from; ++i) {
    EXPECT_NEAR(record.difference(i), 0.364, 0.01) << i;
  }
  for (std::size_t i = running_from + 5; i < 24; ++i) {
    EXPECT_LT(record.difference(i), 0.03) << i;
  }
  EXPECT_LT(record.difference(23), 0.01);
  for (const double gain : record.gain) {
    EXPECT_LT(gain, 1.1 * record.gain.back());
  }
}

}  // namespace trochoid::controlled_motion_test
