#include <gtest/gtest.h>
#include <trochoid/base/error.h>
#include <trochoid/files/step_file.h>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

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

/// A second of samples 1 ms apart: the command, recorded with what a converter adds to it.
std::string recorded(const std::vector<std::pair<int, double>>& steps, double scatter) {
  std::string text = "time_s,command_um,position_um\n";
  double level = 0.0;
  std::size_t next = 0;
  for (int i = 0; i < 1000; ++i) {
    if (next < steps.size() && i >= steps[next].first) level = steps[next++].second;
    const double off = scatter * (i * 7 % 3 - 1);
    text += std::to_string(0.001 * i) + ',' + std::to_string(level + off) + ",0\n";
  }
  return text;
}

TEST(StepFile, ACommandRecordedThroughAConverterIsAStep) {
  const auto file = read(recorded({{200, 10.0}}, 0.01));
  EXPECT_NEAR(file.record.step, 10e-6, 1e-9);
  ASSERT_TRUE(file.record.change);
  EXPECT_NEAR((*file.record.change)[0], 0.199, 1e-9);
  EXPECT_NEAR((*file.record.change)[1], 0.2, 1e-9);
  EXPECT_TRUE(file.notes.empty());
}

TEST(StepFile, OfSeveralStepsInARowOneIsTaken) {
  const std::string text = recorded({{100, 5.0}, {400, -5.0}, {700, 5.0}}, 0.01);
  const auto file = read(text);
  EXPECT_NEAR(file.record.step, -10e-6, 1e-8);
  EXPECT_EQ(file.record.time.size(), file.command.size());
  EXPECT_NEAR(file.record.time.front(), 0.369, 1e-9);
  EXPECT_NEAR(file.record.time.back(), 0.699, 1e-9);
  ASSERT_EQ(file.notes.size(), 1U);
  EXPECT_EQ(file.notes.front().code, "several_steps");
  StepSource last;
  last.start = 0.7;
  EXPECT_NEAR(read(text, last).record.step, 10e-6, 1e-8);
}

TEST(StepFile, ARampIsNoStep) {
  std::vector<std::pair<int, double>> ramp;
  for (int i = 200; i < 300; ++i) ramp.emplace_back(i, 0.1 * (i - 199));
  EXPECT_THROW(read(recorded(ramp, 0.0)), base::InputError);
  EXPECT_THROW(read(recorded(ramp, 0.01)), base::InputError);
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
