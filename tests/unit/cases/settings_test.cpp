#include <trochoid/base/error.h>
#include <trochoid/cases/settings.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace trochoid::cases::settings_test {

using Settings = std::vector<std::string>;

Node a_case() {
  return parse_text("[cut]\nspindle_rpm = 1000\n[[mode]]\nzeta = 0.01\n", "a.toml");
}

Node with(const Settings& settings) {
  return with_settings(a_case(), settings, "folder/a.toml");
}

const Node& at(const Node& root, const char* table, const char* key) {
  return *find(*find(root, table), key);
}

std::vector<std::string> problems_of(const Settings& settings) {
  try {
    with(settings);
  } catch (const base::InputError& error) {
    return error.problems();
  }
  return {};
}

TEST(WithSettings, ValuesAreThoseOfToml) {
  const Node root = with({"cut.spindle_rpm=900", "cut.feed_per_tooth_mm=5e-2",
                          "runout.radial_offsets_mm=[0, 0.01]"});
  EXPECT_EQ(std::get<std::int64_t>(at(root, "cut", "spindle_rpm").value), 900);
  EXPECT_EQ(std::get<double>(at(root, "cut", "feed_per_tooth_mm").value), 0.05);
  EXPECT_EQ(std::get<Array>(at(root, "runout", "radial_offsets_mm").value).size(), 2u);
}

TEST(WithSettings, WhatIsNoTomlIsAText) {
  const Node root = with({"cut.engagement=up", "cut.note=\"1\"", "cut.more=a # b = c",
                          "cut.lines=1\nspindle_rpm = 2", "cut.empty="});
  const auto text = [&](const char* key) {
    return std::get<std::string>(at(root, "cut", key).value);
  };
  EXPECT_EQ(text("engagement"), "up");
  EXPECT_EQ(text("note"), "1");
  EXPECT_EQ(text("more"), "a # b = c");
  EXPECT_EQ(text("lines"), "1\nspindle_rpm = 2");
  EXPECT_EQ(text("empty"), "");
  EXPECT_EQ(std::get<std::int64_t>(at(root, "cut", "spindle_rpm").value), 1000);
}

TEST(WithSettings, TheLastOneCounts) {
  const Node root = with({"cut.spindle_rpm=1", "cut.spindle_rpm=2"});
  EXPECT_EQ(std::get<std::int64_t>(at(root, "cut", "spindle_rpm").value), 2);
}

TEST(WithSettings, StandBesideTheFileWithItsFolder) {
  const Node root = with({"cut={ list = [{ a = 1 }] }"});
  const Node& list = at(root, "cut", "list");
  EXPECT_EQ(to_string(list.where), "--set");
  const Node& entry = *find(std::get<Array>(list.value).front(), "a");
  EXPECT_EQ(to_string(entry.where), "--set");
  EXPECT_EQ(entry.where.file, "folder/a.toml");
}

TEST(WithSettings, NamesEveryOneThatLeadsNowhere) {
  const auto problems = problems_of({"cut", "=3", "mode[2].zeta=1", "cut..a=1", ".=1",
                                     "cut.spindle_rpm.x=1", "mode[1].zeta=0.02"});
  ASSERT_EQ(problems.size(), 6u);
  EXPECT_NE(problems[0].find("must be KEY=VALUE"), std::string::npos) << problems[0];
  EXPECT_NE(problems[2].find("the case has 1 [[mode]]"), std::string::npos)
      << problems[2];
  for (const std::string& problem : problems) {
    EXPECT_TRUE(problem.starts_with("--set")) << problem;
  }
}

}  // namespace trochoid::cases::settings_test
