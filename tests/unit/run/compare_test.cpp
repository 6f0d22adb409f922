#include <trochoid/run/simulate.h>

#include "made_record_file.h"

#include <gtest/gtest.h>

#include <vector>

namespace trochoid::run::compare_test {

using namespace test;

TEST(Compare, FindsThePhaseAndNothingLeft) {
  const CaseFolder folder;
  folder.write("record.csv", csv_text(two_turns(0.3), Axis::angle));
  std::vector<base::Warning> warnings;
  const auto all =
      compare(folder.read(cases::test::slot + runout + measurement), warnings);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_TRUE(warnings.empty());
  EXPECT_NEAR(all[0].match.phase, 0.3, 1e-4);
  EXPECT_LT(all[0].match.rms, 1e-3 * all[0].match.measured_rms);
  EXPECT_EQ(all[0].match.computed.size(), all[0].run.angle.size());
}

TEST(Compare, ReadsTheChannelsAsTheDynamometerHasThem) {
  const CaseFolder folder;
  auto record = two_turns(0.3);
  for (auto& F : record.force) {
    F = {-F[1], F[0], F[2]};
  }
  folder.write("record.csv", csv_text(record, Axis::angle));
  std::vector<base::Warning> warnings;
  const auto all =
      compare(folder.read(cases::test::slot + runout + measurement +
                          "[dynamometer]\naxes = [\"-y\", \"x\", \"z\"]\n"),
              warnings);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_LT(all[0].match.rms, 1e-3 * all[0].match.measured_rms);
}

TEST(Compare, SaysWhyItDoesNot) {
  const CaseFolder folder;
  folder.write("record.csv", csv_text(two_turns(), Axis::angle));
  std::vector<base::Warning> warnings;
  EXPECT_TRUE(compare(folder.read(cases::test::slot + measurement +
                                  "[dynamometer]\naxes = \"auto\"\n"),
                      warnings)
                  .empty());
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "not_compared");
  EXPECT_NE(warnings[0].message.find("identification"), std::string::npos);
}

}  // namespace trochoid::run::compare_test
