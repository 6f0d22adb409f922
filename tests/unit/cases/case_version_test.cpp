#include "case_text.h"

#include <gtest/gtest.h>

namespace trochoid::cases::case_version_test {

using test::CaseFolder;

constexpr const char* refusal =
    "no version of the case file that this program reads; must be 1, or left out (what a "
    "later Trochoid wrote, an earlier one may not read)\n";

TEST(CaseVersion, MayBeStatedAndIsStatedInTheEcho) {
  const CaseFolder folder;
  EXPECT_EQ(folder.problems("schema = 1\n" + test::slot), "");
  EXPECT_EQ(folder.problems("schema = 1.0\n" + test::slot), "");
  const Case c = folder.read(test::slot);
  EXPECT_TRUE(c.as_understood.starts_with("schema = 1\n")) << c.as_understood;
}

TEST(CaseVersion, OfAnotherIsRefusedBeforeAnythingElseIsJudged) {
  const CaseFolder folder;
  const std::string later = "[tool]\nflutes = 2\n";
  EXPECT_EQ(folder.problems("schema = 2\n" + later),
            std::string("case.toml:1:10: schema = 2: ") + refusal);
  EXPECT_EQ(folder.problems("schema = \"one\"\n" + later),
            std::string("case.toml:1:10: schema = \"one\": ") + refusal);
}

TEST(CaseVersion, OfAnIncludedFileCountsAsWell) {
  const CaseFolder folder;
  static_cast<void>(folder.write("old.toml", "schema = 0\n" + test::force));
  EXPECT_EQ(folder.problems("schema = 1\ninclude = \"old.toml\"\n" + test::tool),
            std::string("old.toml:1:10: schema = 0: ") + refusal);
}

TEST(CaseVersion, BelowATableIsToldWhereItBelongs) {
  const CaseFolder folder;
  const std::string said = folder.problems(test::slot + "schema = 1\n");
  EXPECT_NE(said.find("schema stands above all tables"), std::string::npos) << said;
}

}  // namespace trochoid::cases::case_version_test
