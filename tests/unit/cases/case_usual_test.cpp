#include "case_text.h"

#include <trochoid/cases/tables.h>
#include <trochoid/cases/usual_values.h>

#include <gtest/gtest.h>

#include <set>

/// Values that are taken, but hardly meant.
namespace trochoid::cases::case_usual_test {

using test::CaseFolder;

std::string cut(const std::string& change) {
  return R"(
[tool]
teeth = 3
diameter_mm = 12.0
helix_deg = 45.0
[cut]
engagement = "slot"
axial_depth_mm = 4.0
spindle_rpm = 3000
)" + change +
         test::force;
}

TEST(CaseUsual, EachIsAKeyOfTheSchemaAndItsRangeIsWithin) {
  CaseTables tables;
  std::set<std::string> keys;
  for (const TableEntry& table : tables_of(tables)) {
    if (table.count() == 0) table.add();
    table.describe(0, [&](const Key& key, const Field&) {
      const std::string name = std::string(table.name) + "." + std::string(key.name);
      keys.insert(name);
      if (const Range* usual = usual_range(name)) {
        EXPECT_GE(usual->low, key.range.low) << name;
        EXPECT_LE(usual->high, key.range.high) << name;
      }
    });
  }
  for (const UsualValue& usual : usual_values()) {
    EXPECT_TRUE(keys.count(std::string(usual.key)) == 1) << usual.key;
    EXPECT_LT(usual.range.low, usual.range.high) << usual.key;
  }
}

TEST(CaseUsual, AFeedOfThreeMillimetresIsNamedOnce) {
  const CaseFolder folder;
  EXPECT_TRUE(folder.read(cut("feed_per_tooth_mm = 0.1\n")).notes.empty());
  const Case c = folder.read(cut("feed_per_tooth_mm = 3\n"));
  ASSERT_EQ(c.notes.size(), 1);
  EXPECT_EQ(c.notes[0].code, "unusual_value");
  EXPECT_NE(
      c.notes[0].message.find(
          "case.toml:10:21: cut.feed_per_tooth_mm = 3 mm: ordinary are 0 to 1 mm"),
      std::string::npos)
      << c.notes[0].message;
}

TEST(CaseUsual, AFeedAndADepthAreSeenAgainstTheDiameter) {
  const CaseFolder folder;
  const std::string most = cut("feed_per_tooth_mm = 0.96\n");
  EXPECT_TRUE(folder.read(most).notes.empty());
  const Case c = folder.read(cut("feed_per_tooth_mm = 0.97\n"));
  ASSERT_EQ(c.notes.size(), 1);
  EXPECT_EQ(c.notes[0].code, "unusual_value");
  EXPECT_NE(c.notes[0].message.find("case.toml:10:21: cut.feed_per_tooth_mm = 0.97 mm: "
                                    "0.0808 diameters of the tool; ordinary are up to "
                                    "0.08"),
            std::string::npos)
      << c.notes[0].message;
  const auto deep = most.find("axial_depth_mm = 4.0");
  const Case d =
      folder.read(std::string(most).replace(deep, 20, "axial_depth_mm = 61"));
  ASSERT_EQ(d.notes.size(), 1);
  EXPECT_NE(d.notes[0].message.find("5.08 diameters"), std::string::npos);
}

TEST(CaseUsual, AListIsNamedOnceAndEntriesOfTablesAreSeen) {
  const CaseFolder folder;
  const Case c = folder.read(cut("feed_per_tooth_mm = 0.1\n") +
                             "[runout]\nradial_offsets_mm = [0, 0.8, 0.9]\n");
  ASSERT_EQ(c.notes.size(), 1);
  EXPECT_NE(c.notes[0].message.find("runout.radial_offsets_mm"), std::string::npos);
  EXPECT_NE(usual_range("mode[2].mass_kg"), nullptr);
  EXPECT_NE(usual_range("measurement[12].cut.spindle_rpm"), nullptr);
  EXPECT_EQ(usual_range("identify.sweep_um"), nullptr);
}

}  // namespace trochoid::cases::case_usual_test
