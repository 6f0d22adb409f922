#include "case_text.h"

#include <trochoid/base/error.h>
#include <trochoid/cases/inches.h>
#include <trochoid/cases/settings.h>
#include <trochoid/cases/sweep.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace trochoid::cases::inches_test {

const Node& at(const Node& root, const char* table, const char* key) {
  return *find(*find(root, table), key);
}

double number_at(const Node& root, const char* table, const char* key) {
  return std::get<double>(at(root, table, key).value);
}

TEST(Inches, StandForMillimetres) {
  const Node root = parse_text(
      "[tool]\ndiameter_in = 0.5\n[cut]\nfeed_rate_in_per_min = 10\naxial_depth_in = 0.3\n"
      "[runout]\nradial_offsets_in = [0, 0.0003]\n[[pass]]\ncut.radial_depth_in = 1\n",
      "a.toml");
  EXPECT_EQ(number_at(root, "tool", "diameter_mm"), 12.7);
  EXPECT_EQ(number_at(root, "cut", "feed_rate_mm_per_min"), 254);
  EXPECT_EQ(number_at(root, "cut", "axial_depth_mm"),
            7.62);  // 0.3 x 25.4 is a bit less
  const auto& offsets = std::get<Array>(at(root, "runout", "radial_offsets_mm").value);
  EXPECT_EQ(std::get<double>(offsets[1].value), 0.00762);
  const Node& pass = std::get<Array>(find(root, "pass")->value).front();
  EXPECT_EQ(number_at(pass, "cut", "radial_depth_mm"), 25.4);
  EXPECT_EQ(find(*find(root, "tool"), "diameter_in"), nullptr);
  EXPECT_EQ(to_string(at(root, "tool", "diameter_mm").where), "a.toml:2:15");
}

TEST(Inches, OnlyAtTheEndOfALength) {
  EXPECT_EQ(key_in_mm("K_te_N_per_in"), "");
  EXPECT_EQ(key_in_inches("K_te_N_per_mm"), "");
  EXPECT_EQ(key_in_inches("edge_load_N_per_mm3"), "");
  EXPECT_EQ(key_in_mm("_in"), "");
  EXPECT_EQ(key_in_mm("begin"), "");
  EXPECT_EQ(key_in_inches("feed_rate_mm_per_min"), "feed_rate_in_per_min");
}

TEST(Inches, NotBothOfOneLength) {
  const test::CaseFolder folder;
  EXPECT_EQ(
      folder.problems("[tool]\nteeth = 2\nhelix_deg = 30\ndiameter_mm = 12\n"
                      "diameter_in = 0.5\nteeth_in = 3\n" +
                      test::cut + test::force),
      "case.toml:5:1: tool.diameter_in = 0.5: diameter_mm is given as well; give one "
      "of them\n"
      "case.toml:6:1: tool.teeth_in = 3: no such key; did you mean teeth? must be a "
      "whole number from 1 to 64 (number of teeth)\n");
}

TEST(Inches, ACountIsNone) {
  const Node root =
      parse_text("[stability]\naxial_depth_in = [0.1, 1, 50]\n", "a.toml");
  const auto& steps = std::get<Array>(at(root, "stability", "axial_depth_mm").value);
  EXPECT_EQ(std::get<double>(steps[1].value), 25.4);
  EXPECT_EQ(std::get<std::int64_t>(steps[2].value), 50);
}

TEST(Inches, AnIncludingFileWinsInEitherUnit) {
  const Node base = parse_text("[tool]\ndiameter_mm = 12\n", "base.toml");
  const Node root = merged(base, parse_text("[tool]\ndiameter_in = 1\n", "a.toml"));
  EXPECT_EQ(number_at(root, "tool", "diameter_mm"), 25.4);
}

TEST(Inches, AreSetBesideTheCaseAndSwept) {
  Node root = parse_text(
      "[tool]\ndiameter_mm = 12\n[sweep.over]\n\"cut.axial_depth_in\" = "
      "{ from = 1, to = 2, count = 3 }\n",
      "a.toml");
  const std::vector<std::string> settings = {"tool.diameter_in=0.25"};
  root = with_settings(root, settings, "a.toml");
  EXPECT_EQ(number_at(root, "tool", "diameter_mm"), 6.35);
  EXPECT_EQ(path_in_mm("runout.radial_offsets_in[2]"), "runout.radial_offsets_mm[2]");
  EXPECT_EQ(path_in_mm("cut.spindle_rpm"), "cut.spindle_rpm");
  EXPECT_NE(find(at(root, "sweep", "over"), "cut.axial_depth_in"), nullptr);
  set_key(root, {.key = "cut.axial_depth_in", .where = {}, .values = {}},
          Node{.value = 0.1, .where = {}});
  EXPECT_EQ(number_at(root, "cut", "axial_depth_mm"), 2.54);
}

}  // namespace trochoid::cases::inches_test
