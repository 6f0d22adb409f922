#include <trochoid/base/command.h>
#include <trochoid/base/names.h>
#include <trochoid/base/steps.h>
#include <trochoid/base/table.h>
#include <trochoid/base/units.h>

#include <gtest/gtest.h>

#include <set>

namespace trochoid::base::small_values_test {

TEST(Names, AreAllThereAndFindTheirEnumerator) {
  EXPECT_EQ(names<Command>.size(), 11U);
  std::set<std::string_view> different;
  for (const std::string_view name : names<Command>) {
    EXPECT_TRUE(different.insert(name).second);
    EXPECT_EQ(name_of(*named<Command>(name)), name);
    EXPECT_FALSE(purpose_of(*named<Command>(name)).empty());
  }
  EXPECT_FALSE(named<Command>("identifi"));
}

TEST(Steps, ReachBothEndsExactly) {
  const auto all = values(Steps{.first = 0.1, .last = 0.7, .count = 4});
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all.front(), 0.1);
  EXPECT_EQ(all.back(), 0.7);
  EXPECT_NEAR(all[1], 0.3, 1e-15);
}

TEST(Table, ColumnsComeByTheirNames) {
  Table table{"a.csv", {}};
  add_column(table, "x_mm", 3, [](std::size_t i) { return 2 * i; });
  ASSERT_EQ(table.columns.size(), 1U);
  EXPECT_EQ(table.columns[0].name, "x_mm");
  EXPECT_EQ(table.columns[0].values, (std::vector<double>{0, 2, 4}));
}

TEST(Units, AValueComesBackAsItStoodInTheFile) {
  EXPECT_EQ(unit::in(30.0137 * unit::deg, unit::deg), 30.0137);
  EXPECT_EQ(unit::in(875 * unit::rpm, unit::rpm), 875.0);
}

}  // namespace trochoid::base::small_values_test
