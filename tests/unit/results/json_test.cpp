#include <trochoid/results/json.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace trochoid::results::json_test {

TEST(JsonText, PutsListsOfSingleValuesOnOneLine) {
  const Value value = Object{{"force_N", std::array{1.0, -0.1, 2e300}},
                             {"teeth", Array{Object{{"tooth", 1}}}},
                             {"none", Array{}}};
  EXPECT_EQ(json_text(value), R"({
  "force_N": [1, -0.1, 2e+300],
  "teeth": [
    {
      "tooth": 1
    }
  ],
  "none": []
})");
}

TEST(JsonText, ReadsBackTheSame) {
  const std::string text = R"({
  "whole": -3,
  "number": 0.1,
  "truth": true,
  "nothing": null,
  "text": "a \"b\" \u0001 \\"
})";
  EXPECT_EQ(json_text(json_value(text)), text);
  EXPECT_THROW(json_value("{"), std::invalid_argument);
}

TEST(JsonText, HasNoNumberWhereThereIsNone) {
  EXPECT_EQ(json_text(Array{NAN, INFINITY, 1.5}), "[null, null, 1.5]");
}

TEST(JsonQuoted, ReplacesWhatIsNoUtf8) {
  EXPECT_EQ(json_quoted("a\xFF\"b"), "\"a\xEF\xBF\xBD\\\"b\"");
}

}  // namespace trochoid::results::json_test
