#include "case_text.h"

#include <trochoid/cases/sweep.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <sstream>
#include <vector>

namespace trochoid::cases::case_page_test {

using test::CaseFolder;

/// Compare a file of docs/formats with what is made now.
void expect_up_to_date(const std::string& name, const std::string& made) {
  const auto page = std::filesystem::path(TROCHOID_SOURCE_DIR) / "docs/formats" / name;
  if (test::content(page) != made) {
    const auto renewed = std::filesystem::temp_directory_path() / ("trochoid-" + name);
    std::ofstream(renewed) << made;
    FAIL() << "docs/formats/" << name << " is out of date; renew it with\n  cp "
           << renewed.string() << " " << page.string();
  }
}

TEST(CasePage, IsWhatTheSchemaSays) {
  expect_up_to_date("case.md", describe_case_file());
}

TEST(CasePage, JsonSchemaIsWhatTheSchemaSays) {
  expect_up_to_date("case.schema.json", case_schema());
}

TEST(CasePage, HasEveryKeyOfASweep) {
  const auto schema = nlohmann::json::parse(sweep_schema());
  EXPECT_EQ(schema["properties"].size(), sweep_keys().size());
  for (const SweepKeyText& key : sweep_keys()) {
    const auto& form = schema["properties"][key.name];
    EXPECT_GT(form.size(), 1U) << key.name;  // a form, beside the description
    if (form.contains("maximum")) {
      EXPECT_TRUE(key.value.ends_with(form["maximum"].dump())) << key.value;
    }
  }
}

TEST(CasePage, NewSimulateIsAValidCase) {
  const CaseFolder folder;
  EXPECT_EQ(folder.problems(new_case(Command::simulate), Command::simulate), "");
  EXPECT_EQ(folder.problems(new_case(Command::simulate), std::nullopt), "");
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
  EXPECT_EQ(folder.problems(text, std::nullopt), "");
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
  EXPECT_EQ(folder.problems(text, std::nullopt), "");
}

TEST(CasePage, NewStabilityIsAValidCase) {
  const CaseFolder folder;
  const std::string text = new_case(Command::stability);
  EXPECT_EQ(folder.problems(text, Command::stability), "");
  EXPECT_EQ(folder.problems(text, std::nullopt), "");
  EXPECT_EQ(folder.problems(text, Command::simulate), "");
}

TEST(CasePage, NewDynamicsIsAValidCase) {
  const CaseFolder folder;
  const std::string text = new_case(Command::dynamics);
  using Purpose = std::optional<Command>;
  for (const Purpose command :
       {Purpose(Command::dynamics), Purpose(), Purpose(Command::stability),
        Purpose(Command::simulate)}) {
    EXPECT_EQ(folder.problems(text, command), "");
  }
  EXPECT_EQ(folder.read(text, Command::dynamics).machine.modes.size(), 3U);
}

TEST(CasePage, NewCorrectIsAValidCase) {
  const CaseFolder folder;
  const std::string text = new_case(Command::correct);
  using Purpose = std::optional<Command>;
  for (const Purpose command :
       {Purpose(Command::correct), Purpose(), Purpose(Command::dynamics),
        Purpose(Command::stability), Purpose(Command::simulate)}) {
    EXPECT_EQ(folder.problems(text, command), "");
  }
}

TEST(CasePage, EveryLineOfANewCaseIsExplained) {
  for (const Command command :
       {Command::simulate, Command::identify, Command::surface, Command::calibrate,
        Command::stability, Command::dynamics, Command::correct, Command::plan,
        Command::program}) {
    std::istringstream lines(new_case(command));
    for (std::string line; std::getline(lines, line);) {
      EXPECT_TRUE(line.empty() || line.find("# ") != std::string::npos) << line;
    }
  }
}

/// A new case with one of its lines behind a # in force.
std::string with_line(const std::string& text, std::size_t at) {
  std::string out = text;
  out.erase(at, 2);
  return out;
}

/// Where lines stand that are keys or tables behind a #.
std::vector<std::size_t> hidden_lines(const std::string& text) {
  std::vector<std::size_t> out;
  for (std::size_t at = text.find("\n# "); at != std::string::npos;
       at = text.find("\n# ", at + 1)) {
    const std::string line = text.substr(at + 3, text.find('\n', at + 1) - at - 3);
    if (line.find(" = ") < line.find(" #") || line.starts_with("[[")) {
      out.push_back(at + 1);
    }
  }
  return out;
}

TEST(CasePage, WhatIsHiddenInANewCaseIsValidTomlWithoutTheHash) {
  const CaseFolder folder;
  static_cast<void>(folder.write("record.csv", "x"));
  static_cast<void>(folder.write("record2.csv", "x"));
  for (const Command command :
       {Command::simulate, Command::identify, Command::surface, Command::calibrate,
        Command::stability, Command::dynamics, Command::correct, Command::plan}) {
    const std::string text = new_case(command);
    const auto hidden = hidden_lines(text);
    EXPECT_GT(hidden.size(), 10U);
    for (const std::size_t at : hidden) {
      const std::string changed = with_line(text, at);
      const std::string problems = folder.problems(changed, command);
      const std::string name = text.substr(at, 6);
      const bool twice = name == "# axes" || name == "# file";  // in force as well
      EXPECT_TRUE(twice || problems.find("not valid TOML") == std::string::npos)
          << changed.substr(at, 80) << problems;
    }
    if (command != Command::simulate && command != Command::identify) continue;
    for (const std::string key : {"pitch_deg", "columns", "cut", "feed_rate_mm_per_min",
                                  "sample_rate_Hz", "sweep_um", "angles_deg"}) {
      const auto at = text.find("\n# " + key + " = ");
      if (at != std::string::npos) {
        EXPECT_EQ(folder.problems(with_line(text, at + 1), command), "") << key;
      }
    }
  }
}

TEST(CasePage, NewIdentifyShowsASecondRecordAndAxesFoundFromTheRecord) {
  const CaseFolder folder;
  static_cast<void>(folder.write("record.csv", "x"));
  static_cast<void>(folder.write("record2.csv", "x"));
  std::string text = new_case(Command::identify);
  EXPECT_NE(text.find("\naxes = \"auto\""), std::string::npos);
  const auto second = text.find("# [[measurement]]");
  ASSERT_NE(second, std::string::npos);
  for (int line = 0; line < 3; ++line) {
    text.erase(text.find("\n# ", second - 2) + 1, 2);
  }
  EXPECT_EQ(folder.read(text, Command::identify).measurements.size(), 2U);
}

}  // namespace trochoid::cases::case_page_test
