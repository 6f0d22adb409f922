#include <trochoid/base/units.h>
#include <trochoid/run/problems.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace trochoid::run::machine_test {

using cases::Axis;
using cases::ModeBody;

cases::MachineTables table_on_actuator() {
  cases::MachineTables machine;
  machine.modes = {
      {.axis = Axis::y, .stiffness = 8e6, .frequency = 2500, .damping_ratio = 0.025},
      {.axis = Axis::z, .mass = 1.0, .stiffness = 1e6, .damping = 10},
      {.body = ModeBody::table, .mass = 0.194, .stiffness = 1.7e7, .damping = 77.3}};
  machine.actuator = cases::Actuator{.gain = 0.99, .time_constants = {1e-3, 2e-3}};
  return machine;
}

TEST(ChipModes, AreWhatTheChipFeels) {
  const dynamics::System system = chip_modes(table_on_actuator().modes);
  ASSERT_EQ(system.modes.size(), 2U) << "the one along z is left out";
  EXPECT_EQ(system.modes[0].x, 0.0);
  EXPECT_EQ(system.modes[0].y, 1.0);
  EXPECT_EQ(system.modes[1].x, -1.0) << "a table moves against the tool";
  const double omega = 2500 * 2 * std::numbers::pi;
  EXPECT_NEAR(system.modes[0].mass, 8e6 / (omega * omega), 1e-12);
  EXPECT_NEAR(system.modes[0].damping, 2 * 0.025 * 8e6 / omega, 1e-9);
}

TEST(ChipModes, OfADirectionAskewMoveXAndY) {  // [D-1]
  const double angle = 30 * unit::deg;
  const std::vector<cases::Mode> modes = {
      {.angle = angle, .mass = 1.0, .stiffness = 1e6, .damping = 10},
      {.axis = Axis::y, .angle = angle, .mass = 1.0, .stiffness = 1e6, .damping = 10},
      {.body = ModeBody::table,
       .angle = angle,
       .mass = 1.0,
       .stiffness = 1e6,
       .damping = 10}};
  const dynamics::System system = chip_modes(modes);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  EXPECT_DOUBLE_EQ(system.modes[0].x, c);
  EXPECT_DOUBLE_EQ(system.modes[0].y, s);
  EXPECT_DOUBLE_EQ(system.modes[1].x, -s) << "from x towards y turns y towards -x";
  EXPECT_DOUBLE_EQ(system.modes[1].y, c);
  EXPECT_DOUBLE_EQ(system.modes[2].x, -c);
  EXPECT_DOUBLE_EQ(system.modes[2].y, -s);
  EXPECT_FALSE(system.modes[1].of_table) << "though its x is negative";
  EXPECT_TRUE(system.modes[2].of_table);
}

TEST(PlantOf, IsATableHeldByItsActuatorUnlessToldOtherwise) {
  cases::MachineTables machine = table_on_actuator();
  const correction::Plant held = plant_of(machine);
  EXPECT_EQ(held.k_s, 1.7e7);
  EXPECT_EQ(held.c_s, 77.3);
  EXPECT_NEAR(held.actuator.sum, 3e-3, 1e-15);
  machine.actuator->coupling_stiffness = 0.85e7;
  const correction::Plant softer = plant_of(machine);
  EXPECT_EQ(softer.k_s, 0.85e7);
  EXPECT_NEAR(softer.c_s, 77.3 / 2, 1e-12) << "as much damping as stiffness";
  machine.actuator->coupling_damping = 5.0;
  EXPECT_EQ(plant_of(machine).c_s, 5.0);
}

TEST(PlantOf, NeedsAnActuatorAndATable) {
  cases::MachineTables machine = table_on_actuator();
  machine.modes.pop_back();
  EXPECT_THROW(static_cast<void>(plant_of(machine)), std::invalid_argument);
  machine = table_on_actuator();
  machine.actuator.reset();
  EXPECT_THROW(static_cast<void>(plant_of(machine)), std::invalid_argument);
}

TEST(LimitsOf, AreThoseOfTheActuator) {
  cases::Actuator actuator{
      .stroke = {10e-6, 50e-6}, .slew = 0.02, .push = 900, .highest_frequency = 300};
  const correction::ActuatorLimits limits = limits_of(actuator);
  EXPECT_EQ(limits.stroke_low, 10e-6);
  EXPECT_EQ(limits.stroke_high, 50e-6);
  EXPECT_EQ(limits.slew, 0.02);
  EXPECT_EQ(limits.push, 900);
  EXPECT_EQ(limits.pull, 300);
  EXPECT_EQ(limits.most_frequency, 300);
}

}  // namespace trochoid::run::machine_test
