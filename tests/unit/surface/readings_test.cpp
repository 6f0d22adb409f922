#include "made_wall.h"

#include <trochoid/surface/readings.h>

#include <gtest/gtest.h>

#include <random>

namespace trochoid::surface::readings_test {

constexpr double f_z = 0.2e-3;

/// A reading whose error is the number given, at an x that is its travel.
Reading at(double travel, double height, double error, int tooth = -1) {
  return {
      .x = travel, .travel = travel, .height = height, .error = error, .tooth = tooth};
}

TEST(Readings, OneTravelWithinAToothFeedIsOneMean) {  // [E-11]
  // 4 places in each of 6 tooth feeds: the mean over the six, place by place
  std::vector<Reading> readings;
  for (int k = 0; k < 24; ++k) {
    readings.push_back(at(k * f_z / 4, 1e-3, k / 4 + 100.0 * (k % 4)));
  }
  const auto nominal = nominal_errors(readings, Model::quasi_static, f_z, 3);
  ASSERT_EQ(nominal.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(nominal[i].travel, static_cast<double>(i) * f_z / 4, 1e-15);
    EXPECT_NEAR(nominal[i].error, 2.5 + 100.0 * static_cast<double>(i), 1e-12);
    EXPECT_EQ(nominal[i].readings.size(), 6U);
    EXPECT_TRUE(nominal[i].whole);
  }
}

TEST(Readings, JustBelowAToothFeedIsItsStart) {  // [E-11]
  const std::vector<Reading> readings = {at(0.0, 1e-3, 1.0),
                                         at(f_z * (1 - 1e-7), 1e-3, 2.0),
                                         at(2 * f_z * (1 + 1e-7), 1e-3, 6.0)};
  const auto nominal = nominal_errors(readings, Model::quasi_static, f_z, 3);
  ASSERT_EQ(nominal.size(), 1U);
  EXPECT_NEAR(nominal[0].error, 3.0, 1e-12);
}

TEST(Readings, AnUnevenNumberOfTeethIsFlagged) {  // [E-11]
  std::vector<Reading> readings;
  for (int k = 0; k < 7; ++k) readings.push_back(at(k * f_z, 1e-3, 0.0));
  for (const auto& n : nominal_errors(readings, Model::quasi_static, f_z, 3)) {
    EXPECT_FALSE(n.whole);
  }
  readings.resize(6);
  for (const auto& n : nominal_errors(readings, Model::quasi_static, f_z, 3)) {
    EXPECT_TRUE(n.whole);
  }
}

TEST(Readings, LabelsDecideWhereTheyAreGiven) {  // [E-11]
  std::vector<Reading> readings;
  for (int k = 0; k < 6; ++k) {
    readings.push_back(at(k * 0.1e-3, 1e-3, 0.0, k % 2));  // tooth 3 never
  }
  auto nominal = nominal_errors(readings, Model::imprint, f_z, 3);
  ASSERT_EQ(nominal.size(), 1U);
  EXPECT_FALSE(nominal[0].whole);
  for (int k = 0; k < 6; ++k) readings[static_cast<std::size_t>(k)].tooth = k % 3;
  nominal = nominal_errors(readings, Model::imprint, f_z, 3);
  EXPECT_TRUE(nominal[0].whole);
}

TEST(Readings, AnImprintIsAveragedOverATurnOfTheFeed) {  // [E-11]
  // 0, f_z, 2 f_z belong together, 3 f_z begins the next turn
  std::vector<Reading> readings;
  for (int k = 0; k < 9; ++k) readings.push_back(at(5e-3 + k * f_z, 1e-3, k));
  for (const Model model : {Model::imprint, Model::envelope}) {
    const auto nominal = nominal_errors(readings, model, f_z, 3);
    ASSERT_EQ(nominal.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(nominal[i].error, 1.0 + 3.0 * static_cast<double>(i), 1e-12);
      EXPECT_NEAR(nominal[i].x, 5e-3 + f_z * (1.0 + 3.0 * static_cast<double>(i)),
                  1e-12);
      EXPECT_TRUE(nominal[i].whole);
    }
  }
}

TEST(Readings, ClustersFarApartStayApart) {  // [E-11]
  std::vector<Reading> readings;
  for (const double place : {10e-3, 30e-3}) {
    for (int k = 0; k < 3; ++k) readings.push_back(at(place + k * f_z, 1e-3, place));
  }
  const auto nominal = nominal_errors(readings, Model::imprint, f_z, 3);
  ASSERT_EQ(nominal.size(), 2U);
  EXPECT_NEAR(nominal[0].error, 10e-3, 1e-15);
  EXPECT_NEAR(nominal[1].error, 30e-3, 1e-15);
}

TEST(Readings, HeightsAndMeasurementsStayApart) {  // [E-11]
  std::vector<Reading> readings = {at(0.0, 1e-3, 1.0), at(0.0, 2e-3, 2.0),
                                   at(0.0, 1e-3, 3.0)};
  readings[2].set = 1;
  for (const Model model : {Model::quasi_static, Model::imprint, Model::envelope}) {
    const auto nominal = nominal_errors(readings, model, f_z, 1);
    ASSERT_EQ(nominal.size(), 3U);
    EXPECT_EQ(nominal[0].error, 1.0);
    EXPECT_EQ(nominal[1].error, 2.0);
    EXPECT_EQ(nominal[2].error, 3.0);
    EXPECT_EQ(nominal[2].set, 1U);
  }
}

TEST(Readings, TheirOrderInTheFileDoesNotMatter) {  // [E-11]
  std::vector<Reading> readings;
  for (int k = 0; k < 36; ++k) {
    readings.push_back(at(k * f_z / 4, (k % 2 + 1) * 1e-3, 0.1 * k * k));
  }
  auto shuffled = readings;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(3));
  for (const Model model : {Model::quasi_static, Model::imprint}) {
    const auto a = nominal_errors(readings, model, f_z, 3);
    const auto b = nominal_errors(shuffled, model, f_z, 3);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_NEAR(a[i].error, b[i].error, 1e-12);
      EXPECT_EQ(a[i].height, b[i].height);
      EXPECT_EQ(a[i].readings.size(), b[i].readings.size());
    }
  }
}

TEST(Readings, EachIsInExactlyOneMean) {  // [E-11]
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  std::vector<Reading> readings;
  for (int k = 0; k < 300; ++k) {
    readings.push_back(at(60e-3 * any(random), 3e-3 * any(random), 0.0));
  }
  for (const Model model : {Model::quasi_static, Model::imprint}) {
    std::vector<int> seen(300);
    for (const auto& n : nominal_errors(readings, model, f_z, 3)) {
      for (const std::size_t i : n.readings) ++seen[i];
    }
    for (const int count : seen) EXPECT_EQ(count, 1);
  }
}

}  // namespace trochoid::surface::readings_test
