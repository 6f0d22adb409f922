#include "case_text.h"

#include <trochoid/base/names.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace trochoid::inputs {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(TROCHOID_SOURCE_DIR) / "tests/broken/case";

std::vector<std::string> broken_cases() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".toml") {
      names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// `# command: identify` in the first line, none for `check`; else simulate.
std::optional<Command> command_of(const std::string& text) {
  const std::string_view head = "# command: ";
  if (!text.starts_with(head)) {
    return Command::simulate;
  }
  const std::string name = text.substr(head.size(), text.find('\n') - head.size());
  return base::named<Command>(name);
}

class BrokenCase : public testing::TestWithParam<std::string> {};

TEST_P(BrokenCase, IsRefusedInTheseWords) {
  const fs::path before = fs::current_path();
  fs::current_path(folder);  // file names in the messages are those that were given
  const std::string file = GetParam() + ".toml";
  std::string said = "(nothing: the case was accepted)";
  try {
    static_cast<void>(read_case(file, command_of(test::content(file))));
  } catch (const base::InputError& error) {
    said = error.what();
  }
  EXPECT_EQ(said, test::content(GetParam() + ".expected"));
  fs::current_path(before);
}

INSTANTIATE_TEST_SUITE_P(Case, BrokenCase, testing::ValuesIn(broken_cases()),
                         [](const auto& broken) { return broken.param; });

}  // namespace
}  // namespace trochoid::inputs
