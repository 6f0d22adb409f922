#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/cases/case.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

/// The example of a correction, with some of its text replaced.
namespace trochoid::run::test {

using Changes = std::vector<std::pair<std::string, std::string>>;

inline const std::filesystem::path correction_example =
    std::filesystem::path(TROCHOID_SOURCE_DIR) / "examples/runout_correction";

/// @param changes  each is done once, in their order
inline cases::Case correction_case(const Changes& changes = {},
                                   const char* file = "case.toml") {
  std::ostringstream read;
  read << std::ifstream(correction_example / file).rdbuf();
  std::string text = read.str();
  for (const auto& [from, to] : changes) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  }
  const ::testing::TestInfo* now =
      ::testing::UnitTest::GetInstance()->current_test_info();
  const auto path =
      std::filesystem::path(testing::TempDir()) /
      (std::string("trochoid_") + now->test_suite_name() + now->name() + ".toml");
  std::ofstream(path) << text;
  return cases::read_case(path, cases::Command::correct);
}

/// The example whose runout is found in a record.
inline cases::Case measured_case() {
  return correction_case({{"record.csv", (correction_example / "record.csv").string()}},
                         "measured.toml");
}

inline std::vector<std::string> codes(const std::vector<base::Warning>& warnings) {
  std::vector<std::string> all;
  for (const base::Warning& warning : warnings) {
    all.push_back(warning.code);
  }
  return all;
}

}  // namespace trochoid::run::test
