#include "case_text.h"

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

/// `# command: identify` in the first line; else simulate.
Command command_of(const std::string& text) {
  using Named = std::pair<std::string_view, Command>;
  for (const auto& [name, command] :
       {Named{"check", Command::check}, Named{"identify", Command::identify},
        Named{"surface", Command::surface}, Named{"calibrate", Command::calibrate},
        Named{"stability", Command::stability}, Named{"modes", Command::modes},
        Named{"actuator", Command::actuator}, Named{"dynamics", Command::dynamics},
        Named{"correct", Command::correct}}) {
    if (text.starts_with("# command: " + std::string(name) + "\n")) {
      return command;
    }
  }
  return Command::simulate;
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
