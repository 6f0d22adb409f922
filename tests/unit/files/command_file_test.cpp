#include <trochoid/base/error.h>
#include <trochoid/files/command_file.h>

#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

namespace trochoid::files::command_file_test {

namespace {

constexpr double turn = 2 * std::numbers::pi;

CommandTable read(const std::string& text) {
  std::istringstream in(text);
  return read_command(in, "c.csv");
}

std::string problem(const std::string& text) {
  try {
    static_cast<void>(read(text));
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST(CommandFile, IsStraightBetweenItsRowsAndGoesRound) {
  const CommandTable table =
      read("angle_deg,command_um,table_wanted_um\n0,10,1\n90,20,1\n270,-4,1\n");
  ASSERT_EQ(table.angle.size(), 3U);
  EXPECT_NEAR(command_at(table, 0.0), 10e-6, 1e-18);
  EXPECT_NEAR(command_at(table, turn / 8), 15e-6, 1e-18);
  EXPECT_NEAR(command_at(table, turn / 2), 8e-6, 1e-18);
  EXPECT_NEAR(command_at(table, 0.875 * turn), 3e-6, 1e-18);  // back to the first row
  EXPECT_NEAR(command_at(table, 0.875 * turn - 5 * turn), 3e-6, 1e-17);
}

TEST(CommandFile, MayCloseItsTurnAndBeginAnywhere) {
  const CommandTable table =
      read("angle_deg;command_mm\n-90;0,001\n90;0,003\n270;0,001\n");
  ASSERT_EQ(table.angle.size(), 2U);
  EXPECT_NEAR(command_at(table, 0.0), 2e-6, 1e-18);
  EXPECT_NEAR(command_at(table, turn / 2), 2e-6, 1e-18);
}

TEST(CommandFile, SaysWhatIsWrong) {
  EXPECT_EQ(problem("angle_deg,command_um\n0,1\n0,2\n"),
            "c.csv:3:1: the angle 0 deg does not come "
            "after 0 deg: angles must increase\n");
  EXPECT_EQ(problem("angle_deg,command_um\n0,1\n180,2\n400,3\n"),
            "c.csv:4:1: the angle 400 deg lies more than a turn after the first: one "
            "turn is needed, which repeats\n");
  EXPECT_EQ(problem("angle_deg,command_um\n0,1\n"),
            "c.csv:2:1: the command has 1 rows: a whole turn is needed\n");
  EXPECT_NE(
      problem("angle_deg,height_um\n0,1\n1,2\n").find("no column is named command"),
      std::string::npos);
  EXPECT_NE(problem("angle,command_um\n0,1\n1,2\n").find("unit"), std::string::npos);
  EXPECT_NE(problem("angle_deg,command_um\n0,x\n1,2\n").find("c.csv:2:3"),
            std::string::npos);
  EXPECT_NE(problem("").find("no data"), std::string::npos);
}

}  // namespace trochoid::files::command_file_test
