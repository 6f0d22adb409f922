#include "case_text.h"

#include <gtest/gtest.h>

#include <sstream>

namespace trochoid::inputs {
namespace {

using test::CaseFolder;

TEST(CasePage, IsWhatTheSchemaSays) {
  const auto page = std::filesystem::path(TROCHOID_SOURCE_DIR) / "docs/formats/case.md";
  const std::string made = describe_case_file();
  if (test::content(page) != made) {
    const auto renewed = std::filesystem::temp_directory_path() / "trochoid-case.md";
    std::ofstream(renewed) << made;
    FAIL() << "docs/formats/case.md is out of date; renew it with\n  cp "
           << renewed.string() << " " << page.string();
  }
}

TEST(CasePage, NewSimulateIsAValidCase) {
  const CaseFolder folder;
  EXPECT_EQ(folder.problems(new_case(Command::simulate), Command::simulate), "");
  EXPECT_EQ(folder.problems(new_case(Command::check), Command::check), "");
}

TEST(CasePage, NewIdentifyLacksOnlyItsRecord) {
  const CaseFolder folder;
  const std::string text = new_case(Command::identify);
  const std::string problem = folder.problems(text, Command::identify);
  EXPECT_NE(problem.find("measurement[1].file = \"record.csv\": there is no such file"),
            std::string::npos);
  EXPECT_EQ(std::count(problem.begin(), problem.end(), '\n'), 1);
  static_cast<void>(folder.write("record.csv", "x"));
  EXPECT_EQ(folder.problems(text, Command::identify), "");
}

TEST(CasePage, NewSurfaceIsAValidCase) {
  const CaseFolder folder;
  const std::string text = new_case(Command::surface);
  EXPECT_EQ(folder.problems(text, Command::surface), "");
  EXPECT_EQ(folder.problems(text, Command::check), "");
  EXPECT_EQ(folder.problems(text, Command::simulate), "");
}

TEST(CasePage, NewCalibrateLacksOnlyItsSurface) {
  const CaseFolder folder;
  const std::string text = new_case(Command::calibrate);
  const std::string problem = folder.problems(text, Command::calibrate);
  EXPECT_NE(
      problem.find("surface_measurement[1].file = \"wall.csv\": there is no such file"),
      std::string::npos);
  EXPECT_EQ(std::count(problem.begin(), problem.end(), '\n'), 1);
  static_cast<void>(folder.write("wall.csv", "x"));
  EXPECT_EQ(folder.problems(text, Command::calibrate), "");
  EXPECT_EQ(folder.problems(text, Command::check), "");
}

TEST(CasePage, EveryLineOfANewCaseIsExplained) {
  for (const Command command :
       {Command::simulate, Command::identify, Command::surface, Command::calibrate}) {
    std::istringstream lines(new_case(command));
    for (std::string line; std::getline(lines, line);) {
      EXPECT_TRUE(line.empty() || line.find("# ") != std::string::npos) << line;
    }
  }
}

}  // namespace
}  // namespace trochoid::inputs
