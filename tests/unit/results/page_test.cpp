#include <trochoid/results/descriptions.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace trochoid::results::page_test {

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return std::move(text).str();
}

TEST(ResultsPage, IsWhatTheAnswersAreMadeOf) {
  const auto page =
      std::filesystem::path(TROCHOID_SOURCE_DIR) / "docs/formats/results.md";
  const std::string stored = content(page);
  const std::string made = page_with_descriptions(stored);
  if (made != stored) {
    const auto renewed = std::filesystem::temp_directory_path() / "trochoid-results.md";
    std::ofstream(renewed) << made;
    FAIL() << "docs/formats/results.md is out of date; renew it with\n  cp "
           << renewed.string() << " " << page.string();
  }
}

TEST(ResultsPage, HasAPlaceForEveryCommandThatIsDescribed) {
  const std::string page =
      content(std::filesystem::path(TROCHOID_SOURCE_DIR) / "docs/formats/results.md");
  for (const Description& one : descriptions()) {
    EXPECT_NE(page.find("<!-- " + std::string(one.command) + ": made of"), page.npos)
        << one.command;
  }
}

TEST(ResultsPage, SaysSomethingOfEveryKeyAndColumnOnce) {
  for (const Description& one : descriptions()) {
    for (std::size_t i = 0; i < one.keys.size(); ++i) {
      EXPECT_FALSE(one.keys[i].meaning.empty()) << one.keys[i].path;
      for (std::size_t k = 0; k < i; ++k) {
        EXPECT_NE(one.keys[k].path, one.keys[i].path) << one.command;
      }
    }
    for (const ColumnText& column : one.columns) {
      EXPECT_FALSE(column.meaning.empty()) << column.file << " " << column.name;
    }
  }
}

}  // namespace trochoid::results::page_test
