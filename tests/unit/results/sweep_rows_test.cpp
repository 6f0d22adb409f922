#include <trochoid/results/sweep_rows.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace trochoid::results::sweep_rows_test {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

SweepRows made() {
  return SweepRows({{.cells = {1.0, 0.1, none}, .status = "ok", .message = ""},
                    {.cells = {2.0, "up", 4.0}, .status = "failed", .message = "why"},
                    {.cells = {3.0, "", 5.0}, .status = "ok", .message = ""},
                    {.cells = {4.0, none, 6.0}, .status = "failed", .message = "why"}});
}

TEST(SweepRows, GiveBackWhatWasAdded) {
  const SweepRows rows = made();
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(std::get<double>(rows.row(0).cells[1]), 0.1);
  EXPECT_TRUE(std::isnan(std::get<double>(rows.row(0).cells[2])));
  EXPECT_EQ(std::get<std::string>(rows.row(1).cells[1]), "up");
  EXPECT_EQ(rows.row(1).message, "why");
  EXPECT_EQ(rows.number(3, 2), 6.0);
  EXPECT_TRUE(std::isnan(rows.number(1, 1)));
  EXPECT_EQ(rows.messages().words().size(), 2U);
}

TEST(SweepRows, AColumnWithATextIsOfTexts) {
  const SweepRows rows = made();
  const base::Table::Column numbers = rows.column("a", 0, 2);
  EXPECT_EQ(numbers.values, (std::vector<double>{1, 3}));
  EXPECT_TRUE(numbers.texts.empty());
  const base::Table::Column texts = rows.column("b", 1, 1);
  EXPECT_TRUE(texts.values.empty());
  ASSERT_EQ(texts.texts.size(), 4U);
  EXPECT_EQ(texts.texts[0], "0.1");
  EXPECT_EQ(texts.texts[1], "up");
  EXPECT_EQ(texts.texts[3], "");
}

TEST(SweepRows, AreCut) {
  SweepRows rows = made();
  rows.cut(9);
  EXPECT_EQ(rows.size(), 4U);
  rows.cut(1);
  EXPECT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows.column("a", 0, 1).values.size(), 1U);
  EXPECT_EQ(rows.row(0).status, "ok");
}

}  // namespace trochoid::results::sweep_rows_test
