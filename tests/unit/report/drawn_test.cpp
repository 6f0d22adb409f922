#include <gtest/gtest.h>
#include <trochoid/report/drawn.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace trochoid::report::drawn_test {

base::Table wave(std::size_t count) {
  base::Table table{"forces.csv", {{"angle_deg", {}}, {"Fx_N", {}}}};
  for (std::size_t i = 0; i < count; ++i) {
    const double x = static_cast<double>(i);
    table.columns[0].values.push_back(x);
    table.columns[1].values.push_back(std::sin(0.01 * x));
  }
  return table;
}

TEST(Drawn, AreAllRowsOfASmallTable) {
  const auto rows = drawn_rows(wave(100), 1000);
  ASSERT_EQ(rows.size(), 100U);
  EXPECT_EQ(rows.front(), 0U);
  EXPECT_EQ(rows.back(), 99U);
}

TEST(Drawn, AreNoMoreThanAskedForAndInOrder) {
  const auto table = wave(100'000);
  const auto rows = drawn_rows(table, 4000);
  EXPECT_LE(rows.size() * table.columns.size(), 4000U);
  EXPECT_GT(rows.size() * table.columns.size(), 1000U);
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
  EXPECT_EQ(std::adjacent_find(rows.begin(), rows.end()), rows.end());
  EXPECT_EQ(rows.front(), 0U);
  EXPECT_EQ(rows.back(), 99'999U);
}

TEST(Drawn, KeepEveryPeak) {
  auto table = wave(100'000);
  table.columns[1].values[54'321] = 7.0;
  table.columns[1].values[77'777] = -7.0;
  const auto rows = drawn_rows(table, 4000);
  EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), 54'321U));
  EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), 77'777U));
}

TEST(Drawn, KeepTheBeginningOfEveryRunWhole) {
  auto table = wave(100'000);
  table.columns.insert(table.columns.begin(),
                       {"run", std::vector<double>(100'000, 1.0)});
  for (std::size_t i = 60'000; i < 100'000; ++i) table.columns[0].values[i] = 2.0;
  const auto rows = drawn_rows(table, 6000);
  EXPECT_LE(rows.size() * table.columns.size(), 6000U);
  for (std::size_t i = 0; i < 200; ++i) {
    EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), i)) << i;
    EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), 60'000 + i)) << i;
  }
}

TEST(Drawn, KeepPeaksBesideMissingNumbers) {
  auto table = wave(100'000);
  for (std::size_t i = 0; i < 100'000; i += 2) {
    table.columns[1].values[i] = std::numeric_limits<double>::quiet_NaN();
  }
  table.columns[1].values[54'321] = 7.0;
  const auto rows = drawn_rows(table, 4000);
  EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), 54'321U));
}

TEST(Drawn, KeepEveryHeightOfAMapWithItsEndsAndPeaks) {
  constexpr std::size_t heights = 50;
  constexpr std::size_t along = 2000;
  base::Table map{"surface.csv", {{"x_mm", {}}, {"height_mm", {}}, {"error_mm", {}}}};
  for (std::size_t i = 0; i < heights * along; ++i) {
    map.columns[0].values.push_back(static_cast<double>(i % along));
    map.columns[1].values.push_back(static_cast<double>(i / along));
    map.columns[2].values.push_back(std::sin(0.02 * static_cast<double>(i % along)));
  }
  map.columns[2].values[7 * along + 1234] = 5.0;
  const auto rows = drawn_rows(map, 30'000);
  EXPECT_LE(rows.size() * map.columns.size(), 30'000U);
  EXPECT_GT(rows.size() * map.columns.size(), 20'000U);
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
  EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), 7 * along + 1234));
  for (std::size_t h = 0; h < heights; ++h) {
    EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), h * along)) << h;
    EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), (h + 1) * along - 1)) << h;
  }
}

TEST(Drawn, BecomeJsonWithoutAnythingThatIsNoNumber) {
  const base::Table table{
      "chip \"1\".csv",
      {{"h_mm", {0.1, std::numeric_limits<double>::infinity(), -1234567.0}}}};
  const auto json = nlohmann::json::parse(tables_json({table}));
  EXPECT_EQ(json[0]["file"], "chip \"1\".csv");
  EXPECT_EQ(json[0]["rows"], 3);
  EXPECT_EQ(json[0]["drawn"], 3);
  EXPECT_EQ(json[0]["columns"][0]["values"].dump(), "[0.1,null,-1234567]");
}

TEST(Drawn, MayBeNothing) {
  EXPECT_EQ(tables_json({}), "[]");
  const auto json =
      nlohmann::json::parse(tables_json({{"a.csv", {}}, {"b.csv", {{"x", {}}}}}));
  EXPECT_EQ(json.size(), 2U);
}

}  // namespace trochoid::report::drawn_test
