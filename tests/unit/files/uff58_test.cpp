#include "uff58_made.h"

#include <gtest/gtest.h>
#include <trochoid/base/error.h>
#include <trochoid/files/uff58.h>

#include <string>

namespace trochoid::files::uff58_test {

MadeSet made(int type, bool even) {
  MadeSet set{.type = type, .even = even};
  for (int i = 0; i < 7; ++i) {
    set.x.push_back(even ? 10.0 + 0.5 * i : 10.0 + 0.5 * i * i);
    set.y.emplace_back(-1.5 + i, type >= 5 ? 0.25 * i : 0.0);
  }
  return set;
}

void expect_same(const UffFile& file, const MadeSet& set) {
  ASSERT_EQ(file.sets.size(), 1u);
  const Uff58& read = file.sets[0];
  ASSERT_EQ(read.y.size(), set.y.size());
  for (std::size_t i = 0; i < set.y.size(); ++i) {
    EXPECT_DOUBLE_EQ(read.x[i], set.x[i]);
    EXPECT_EQ(read.y[i], set.y[i]);  // sums of few powers of 2: exact in single too
  }
  EXPECT_EQ(read.function_type, 4);
  EXPECT_EQ(read.response_node, 7);
  EXPECT_EQ(read.response_direction, -1);
  EXPECT_EQ(read.reference_direction, 1);
  EXPECT_EQ(read.id[0], "tip of the tool");
  EXPECT_EQ(read.ordinate.type, 12);
  EXPECT_EQ(read.ordinate.unit, "m/s2");
  EXPECT_EQ(read.denominator.unit, "N");
  EXPECT_EQ(read.abscissa.label, "Frequency");
}

TEST(Uff58, IsReadInEveryFormThatItIsWrittenIn) {
  for (const int type : {2, 4, 5, 6}) {
    for (const bool even : {true, false}) {
      SCOPED_TRACE(type * 10 + (even ? 1 : 0));
      const MadeSet set = made(type, even);
      expect_same(read_uff(as_text(set), "made"), set);
      expect_same(read_uff(as_binary(set, false), "made"), set);
      expect_same(read_uff(as_binary(set, true), "made"), set);
    }
  }
}

TEST(Uff58, SeveralSetsOfSeveralKindsInOneFile) {
  const MadeSet set = made(5, true);
  const std::string other = "    -1\n    15\n  1  0  0  0  0.0  0.0  0.0\n    -1\n";
  const auto file = read_uff(
      as_binary(set, true) + other + as_text(set) + other + as_binary(set, false),
      "made");
  EXPECT_EQ(file.sets.size(), 3u);
  EXPECT_EQ(file.others, (std::vector<int>{15, 15}));
  EXPECT_EQ(file.sets[2].y, set.y);
}

TEST(Uff58, WindowsLineEndsAndFortranExponents) {
  MadeSet set = made(5, true);
  std::string text = as_text(set);
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) {
    text.insert(at, "\r");
  }
  for (char& c : text) {
    if (c == 'E') c = 'D';
  }
  const auto file = read_uff(text, "made");
  EXPECT_EQ(file.sets.at(0).y, set.y);
}

TEST(Uff58, FewerPointsThanPromisedAreToldByTheCounts) {
  MadeSet set = made(5, true);
  set.promised = 4000;
  for (const auto& text : {as_text(set), as_binary(set, false)}) {
    const auto file = read_uff(text, "made");
    EXPECT_EQ(file.sets.at(0).promised, 4000u);
    EXPECT_EQ(file.sets.at(0).y.size(), 7u);
  }
}

void expect_problem(const std::string& text, const std::string& place,
                    const std::string& words) {
  try {
    read_uff(text, "made.uff");
    FAIL() << "accepted: " << words;
  } catch (const base::InputError& error) {
    const auto& line = error.problems().front();
    EXPECT_EQ(line.substr(0, place.size()), place) << line;
    EXPECT_NE(line.find(words), std::string::npos) << line;
  }
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

TEST(Uff58, WhatIsWrongIsToldWithItsPlace) {
  const MadeSet set = made(6, true);
  const std::string text = as_text(set);
  expect_problem(replaced(text, "2.50000000000E-01", "2.50000000000E-x1"),
                 "made.uff:14:", "not a finite number");
  expect_problem(text.substr(0, text.find("Frequency")), "made.uff:10:1", "cut off");
  expect_problem("    -1\n    58\n", "made.uff:2:1", "cut off");
  expect_problem(replaced(text, "         6         7", "         3         7"),
                 "made.uff:9:1", "no type of data");
  expect_problem(replaced(text, "         6         7", "         6         0"),
                 "made.uff:9:1", "number of points");
  expect_problem("    -1\n    -1\nrubbish\n", "made.uff:2:1", "number of a data set");
  expect_problem("    -1\n  15\n    -1\nrubbish\n", "made.uff:4:1", "must begin with");
  expect_problem(replaced(as_binary(set, false), "     1     2          11",
                          "     1     1          11"),
                 "made.uff:2:1", "IEEE");
  MadeSet nan = set;
  nan.y[3] = {std::nan(""), 0.0};
  expect_problem(as_binary(nan, true), "made.uff:2:1", "byte ");
}

}  // namespace trochoid::files::uff58_test
