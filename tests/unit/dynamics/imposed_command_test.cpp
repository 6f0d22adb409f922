#include <trochoid/base/units.h>
#include <trochoid/dynamics/imposed_command.h>

#include <gtest/gtest.h>

#include <cmath>

namespace trochoid::dynamics::imposed_command_test {

constexpr double Omega = 20 * unit::turn;  // a turn lasts 50 ms

TEST(ImposedCommand, HasItsShapeOverATurn) {
  const auto at = [](CommandShape shape, double turns) {
    return command_over_time({.shape = shape, .peak_to_peak = 26e-6},
                             Omega)(turns / 20);
  };
  EXPECT_NEAR(at(CommandShape::sine, 0.25), 13e-6, 1e-15);
  EXPECT_NEAR(at(CommandShape::sine, 3 + 1.0 / 12), 6.5e-6, 1e-15);
  EXPECT_NEAR(at(CommandShape::square, 0.1), 13e-6, 1e-15);
  EXPECT_NEAR(at(CommandShape::square, 0.6), -13e-6, 1e-15);
  EXPECT_NEAR(at(CommandShape::trapezoid, 1.0 / 24), 6.5e-6, 1e-15);
  EXPECT_NEAR(at(CommandShape::trapezoid, 0.25), 13e-6, 1e-15);
  EXPECT_NEAR(at(CommandShape::trapezoid, 0.5), 0.0, 1e-15);
  EXPECT_NEAR(at(CommandShape::trapezoid, 0.75), -13e-6, 1e-15);
}

TEST(ImposedCommand, RunsEarlierByItsLead) {
  const auto command = command_over_time({.peak_to_peak = 26e-6, .lead = 0.002}, Omega);
  EXPECT_NEAR(command(0.0105), 13e-6 * std::sin(Omega * 0.0125), 1e-15);
}

TEST(ImposedCommand, OfATableIsAboutItsMean) {
  // Up and down by 10 um about 30 um, straight between four rows.
  const CommandTable table{{0, unit::turn / 4, unit::turn / 2, 0.75 * unit::turn},
                           {30e-6, 40e-6, 30e-6, 20e-6}};
  const auto command =
      command_over_time({.shape = CommandShape::table, .table = table}, Omega);
  EXPECT_NEAR(command(0.0), 0.0, 1e-18);
  EXPECT_NEAR(command(0.0125), 10e-6, 1e-15);
  EXPECT_NEAR(command(0.05 + 0.00625), 5e-6, 1e-15);
  EXPECT_NEAR(command(0.0375), -10e-6, 1e-15);
  EXPECT_NEAR(command_at(table, 1.25 * unit::turn), 40e-6, 1e-15);
}

}  // namespace trochoid::dynamics::imposed_command_test
