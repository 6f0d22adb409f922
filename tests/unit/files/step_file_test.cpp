#include <gtest/gtest.h>
#include <trochoid/base/error.h>
#include <trochoid/files/step_file.h>

#include <sstream>
#include <string>

namespace trochoid::files::step_file_test {

StepFile read(const std::string& text, const StepSource& source = {}) {
  std::istringstream in(text);
  return read_step(in, "made.csv", source);
}

TEST(StepFile, HeightAndTimeOfTheStepComeFromTheCommand) {
  const auto file =
      read("time_ms,command_um,position_um\n0,1,0\n1,1,0.1\n2,7,0.5\n3,7,5\n");
  EXPECT_NEAR(file.record.step, 6e-6, 1e-18);
  ASSERT_TRUE(file.record.change);
  EXPECT_DOUBLE_EQ((*file.record.change)[0], 0.001);
  EXPECT_DOUBLE_EQ((*file.record.change)[1], 0.002);
  EXPECT_DOUBLE_EQ(file.record.position[3], 5e-6);
  EXPECT_FALSE(file.record.start);
}

TEST(StepFile, OrTheyAreGiven) {
  StepSource source;
  source.step = 6e-6;
  source.start = 0.001;
  const auto file = read("time_s;position_mm\n0;0\n0,5;0,005\n", source);
  EXPECT_EQ(file.record.step, 6e-6);
  EXPECT_EQ(file.record.start, 0.001);
  EXPECT_DOUBLE_EQ(file.record.position[1], 5e-6);
}

void expect_problem(const std::string& text, const std::string& place,
                    const std::string& words, const StepSource& source = {}) {
  try {
    read(text, source);
    FAIL() << "accepted: " << words;
  } catch (const base::InputError& error) {
    const auto& line = error.problems().front();
    EXPECT_EQ(line.substr(0, place.size() + 1), place + ":") << line;
    EXPECT_NE(line.find(words), std::string::npos) << line;
  }
}

TEST(StepFile, WhatIsWrongIsToldWithItsPlace) {
  expect_problem("", "made.csv:1:1", "no data");
  expect_problem("time_s,position_um\n0,0\n1,1\n", "made.csv:1:1", "--step-um");
  expect_problem("time_s,command_um\n0,0\n1,1\n", "made.csv:1:1", "position_um");
  expect_problem("time_s,command_um,position\n0,0,0\n1,1,1\n", "made.csv:1:19",
                 "no unit");
  expect_problem("time_s,command_um,position_um\n0,0,0\n1,1,x\n", "made.csv:3:5",
                 "not a number");
  expect_problem("time_s,command_um,position_um\n0,0,0\n", "made.csv:2:1", "1 samples");
  expect_problem("time_s,command_um,position_um\n1,0,0\n0,1,0\n", "made.csv:3:1",
                 "increase");
  expect_problem("time_s,command_um,position_um\n0,0,0\n1,0,0\n", "made.csv:3:1",
                 "same at the end");
  expect_problem("time_s,command_um,position_um\n0,0,0\n1,3,0\n2,6,0\n3,6,0\n",
                 "made.csv:1:1", "is no step");
  StepSource other;
  other.step = 5e-6;
  expect_problem("time_s,command_um,position_um\n0,0,0\n1,6,0\n", "made.csv:1:1",
                 "must agree", other);
}

}  // namespace trochoid::files::step_file_test
