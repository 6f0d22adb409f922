#include <gtest/gtest.h>

#include <trochoid/results/folder.h>
#include <trochoid/results/json.h>
#include <trochoid/results/number.h>
#include <trochoid/results/provenance.h>
#include <algorithm>
#include <ostream>
#include <sstream>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>
#include <stdexcept>

namespace trochoid::results::summary_test {

std::string number(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

TEST(Number, IsTheShortestTextThatReadsBackTheSame) {
  EXPECT_EQ(number(0.1), "0.1");
  EXPECT_EQ(number(2620.0), "2620");
  EXPECT_EQ(number(1.0 / 3.0), "0.3333333333333333");
  EXPECT_EQ(number(5e-324), "5e-324");
  EXPECT_EQ(number(9007199254740993.0), "9007199254740992");
  EXPECT_EQ(std::stod(number(0.1 + 0.2)), 0.1 + 0.2);
}

TEST(Number, IsNothingWhereThereIsNoNumber) {
  EXPECT_EQ(number(std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(number(-std::numeric_limits<double>::infinity()), "");
}

TEST(Summary, HasExactlyTheShapeOfEveryCommand) {
  Answer answer;
  answer.command = "simulate";
  answer.heading.message = "Two teeth cut.";
  answer.heading.warnings = {
      {"idle_tooth", "Tooth 2 \"cuts\" nothing: h < 0 \xC2\xB5m."}};
  answer.result =
      json_value(R"({"mean_N": [1.0, -2.5, 0.1], "teeth": [{"tooth": 1}]})");
  const auto read = nlohmann::ordered_json::parse(summary_json(answer));
  const nlohmann::ordered_json expected = {
      {"trochoid", {{"version", version()}, {"commit", commit()}, {"schema", 1}}},
      {"command", "simulate"},
      {"status", "ok"},
      {"message", "Two teeth cut."},
      {"warnings",
       {{{"code", "idle_tooth"},
         {"message", "Tooth 2 \"cuts\" nothing: h < 0 \xC2\xB5m."}}}},
      {"result", {{"mean_N", {1, -2.5, 0.1}}, {"teeth", {{{"tooth", 1}}}}}},
  };
  EXPECT_EQ(read.dump(), expected.dump());
}

TEST(Summary, KeepsShapesEvenIfEmpty) {
  Answer answer;
  answer.heading.ok = false;
  const auto read = nlohmann::ordered_json::parse(summary_json(answer));
  EXPECT_EQ(read.at("status"), "failed");
  EXPECT_TRUE(read.at("warnings").is_array());
  EXPECT_TRUE(read.at("warnings").empty());
  EXPECT_TRUE(read.at("result").is_object());
}

TEST(Summary, WritesNumbersAsShortAsTheyAre) {
  Answer answer;
  answer.result =
      json_value(R"({"a": 0.30000000000000004, "b": 2.0, "c": null, "d": 12})");
  const std::string text = summary_json(answer);
  EXPECT_NE(text.find("\"a\": 0.30000000000000004"), std::string::npos) << text;
  EXPECT_NE(text.find("\"b\": 2,"), std::string::npos) << text;
  EXPECT_NE(text.find("\"c\": null"), std::string::npos) << text;
  EXPECT_NE(text.find("\"d\": 12"), std::string::npos) << text;
}

TEST(Summary, SurvivesTextThatIsNotUtf8) {
  Answer answer;
  answer.heading.message = "latin1: \xB5m";
  EXPECT_TRUE(nlohmann::json::accept(summary_json(answer)));
}

TEST(Csv, HasOneHeadAndOneRowPerValue) {
  const base::Table table{"forces.csv",
                          {{"angle_deg", {0.0, 0.5}}, {"Fx_N", {-1.25, 1e-7}}}};
  EXPECT_EQ(csv(table), "angle_deg,Fx_N\n0,-1.25\n0.5,1e-07\n");
}

TEST(Csv, LeavesACellEmptyWhereThereIsNoNumber) {
  const base::Table table{
      "forces.csv",
      {{"a", {1.0}}, {"b", {std::numeric_limits<double>::quiet_NaN()}}, {"c", {3.0}}}};
  EXPECT_EQ(csv(table), "a,b,c\n1,,3\n");
}

TEST(Csv, RefusesColumnsOfDifferentLengths) {
  const base::Table table{"forces.csv", {{"a", {1.0, 2.0}}, {"b", {1.0}}}};
  EXPECT_THROW(static_cast<void>(csv(table)), std::invalid_argument);
}

TEST(Csv, ALongTableIsHandedOnInPieces) {
  // what a stream gets at once stays small, and is the same text
  struct Pieces : std::stringbuf {
    std::streamsize longest = 0;
    std::streamsize xsputn(const char* text, std::streamsize size) override {
      longest = std::max(longest, size);
      return std::stringbuf::xsputn(text, size);
    }
  };
  base::Table table{"long.csv", {}};
  base::add_column(table, "a", 100000,
                   [](std::size_t i) { return static_cast<double>(i) / 7.0; });
  Pieces pieces;
  std::ostream out(&pieces);
  write_csv(out, table);
  EXPECT_EQ(pieces.str(), csv(table));
  EXPECT_GT(pieces.str().size(), 1000000U);
  EXPECT_LT(pieces.longest, 300000);
}

}  // namespace trochoid::results::summary_test
