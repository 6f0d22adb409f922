// Hammer blows in time: which column is what, in which unit, and what is wrong.
#include <gtest/gtest.h>
#include <trochoid/base/error.h>
#include <trochoid/files/frf_file.h>

#include <algorithm>
#include <string>

namespace trochoid::files::tap_file_test {

using structure::ResponseKind;

/// A hundred samples at 1 kHz.
std::string record(const std::string& head, const std::string& more = "") {
  std::string text = head + "\n";
  for (int i = 0; i < 100; ++i) {
    text += std::to_string(0.001 * i) + "," + std::to_string(i == 20 ? 100 : 0) + "," +
            std::to_string(i % 7) + more + "\n";
  }
  return text;
}

void expect_problem(const std::string& text, const std::string& words,
                    const FrfSource& source = {}) {
  try {
    read_frf(text, "made.csv", source);
    FAIL() << "no problem with " << words;
  } catch (const base::InputError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(TapFile, ATableWithTimeAndForceIsBlows) {
  const FrfFile file =
      read_frf(record("time_s,hammer_kN,acc_g"), "made.csv", FrfSource{});
  ASSERT_TRUE(file.tap);
  EXPECT_EQ(file.response.kind, ResponseKind::accelerance);
  EXPECT_NEAR(file.tap->sample_rate, 1000, 1e-6);
  EXPECT_EQ(file.tap->force[20], 100e3);
  EXPECT_NEAR(file.tap->response[3], 3 * 9.80665, 1e-12);
  EXPECT_TRUE(file.notes.empty());
}

TEST(TapFile, UnitsMayStandInBrackets) {
  for (const auto* const head :
       {"time [s],force [N],acceleration [m/s^2]", "t(s),Fx(N),acceleration_(m/s2)",
        "Time_s,Force_N,Acceleration_m/s/s", "Time (s),Force (N),Acceleration (m/s^2)",
        "Time (s),Hammer force (N),Tip acceleration (m/s^2)",
        "time [s],Impact hammer [N],Response acceleration [m/s2]",
        "Time (s),Hammer_N,tip acc_m/s2", "t_s,F_N,a_m_per_s2",
        "Zeit [s],Kraft [N],Beschleunigung [m/s2]",
        "Zeit (s),Hammer Kraft (N),Beschleunigung x (m/s^2)"}) {
    const FrfFile file = read_frf(record(head), "made.csv", FrfSource{});
    ASSERT_TRUE(file.tap) << head;
    EXPECT_EQ(file.tap->response[3], 3.0) << head;
  }
  const FrfFile file =
      read_frf(record("time_ms,force_N,displacement_um"), "made.csv", FrfSource{});
  EXPECT_EQ(file.response.kind, ResponseKind::receptance);
  EXPECT_NEAR(file.tap->response[3], 3e-6, 1e-18);
  EXPECT_NEAR(file.tap->sample_rate, 1e6, 1e-3);
}

TEST(TapFile, UnitsMayBePoundsAndInches) {
  const FrfFile file =
      read_frf(record("Time (s),Hammer force (lbf),Acceleration (in/s^2)"), "made.csv",
               FrfSource{});
  ASSERT_TRUE(file.tap);
  EXPECT_NEAR(file.tap->force[20], 100 * 4.4482216152605, 1e-9);
  EXPECT_NEAR(file.tap->response[3], 3 * 0.0254, 1e-12);
}

TEST(TapFile, VoltsNeedAScaleAndAKind) {
  const std::string volts = record("Time (s),Hammer (V),Accelerometer (V)");
  const FrfFile file = read_frf(
      volts, "made.csv", {.kind = ResponseKind::accelerance, .scale = {400, 98}});
  ASSERT_TRUE(file.tap);
  EXPECT_EQ(file.response.kind, ResponseKind::accelerance);
  EXPECT_DOUBLE_EQ(file.tap->force[20], 40e3);
  EXPECT_DOUBLE_EQ(file.tap->response[3], 3 * 98);
  EXPECT_TRUE(file.notes.empty());
  expect_problem(volts, "no unit of a force");
  expect_problem(volts, "kind", {.scale = {400, 98}});
}

TEST(TapFile, OneOfSeveralResponsesIsChosen) {
  const std::string two = record("time_s,force_N,acc_g,velocity_m/s", ",5");
  expect_problem(two, "2 responses: choose one by --dataset");
  const FrfFile file = read_frf(two, "made.csv", {.dataset = 2});
  EXPECT_EQ(file.response.kind, ResponseKind::mobility);
  EXPECT_EQ(file.tap->response[3], 5.0);
}

TEST(TapFile, WhatIsWrongIsSaid) {
  expect_problem(record("time_s,force_N,strain"), "no column is a response");
  expect_problem(record("time_s,force_N,acc"),
                 "made.csv:1:16: the response \"acc\" says "
                 "no unit");
  expect_problem(record("time_s,force_mV,acc_g"), "no unit of a force");
  expect_problem(record("time_s,force_N,acc_mV"), "has no unit of motion");
  expect_problem(record("time_h,force_N,acc_g"), "s is right");
  expect_problem(record("time_s,force_N,acc_g,hammer_N", ",1"),
                 "could both be the force");
  expect_problem(record("time_s,force_N,acc_g"), "does not fit the given kind",
                 {.kind = ResponseKind::mobility});
  expect_problem("time_s,force_N,acc_g\n0,1,2\n1,1,2\n2,1,2\n", "at least 64");
  std::string uneven = record("time_s,force_N,acc_g");
  uneven.replace(uneven.find("0.050000"), 8, "0.053000");
  expect_problem(uneven, "made.csv:52:1: the times are not evenly spaced");
}

}  // namespace trochoid::files::tap_file_test
