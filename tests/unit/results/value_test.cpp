#include <trochoid/results/json.h>
#include <trochoid/results/value.h>

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <vector>

namespace trochoid::results::value_test {

TEST(Value, IsMadeOfWhatAResultHolds) {
  EXPECT_EQ(json_text(std::optional<double>{}), "null");
  EXPECT_EQ(json_text(std::optional<double>{2.5}), "2.5");
  EXPECT_EQ(json_text(std::vector<std::string>{"a", "b"}), R"(["a", "b"])");
  EXPECT_EQ(json_text(std::array<std::array<double, 2>, 1>{{{1, 2}}}),
            "[\n  [1, 2]\n]");
  EXPECT_EQ(json_text(std::size_t{7}), "7");
  EXPECT_EQ(json_text(true), "true") << "a truth is no whole number";
}

TEST(Value, IsFoundByItsKey) {
  const Value value = Object{{"a", 1}, {"b", "text"}};
  ASSERT_NE(find(value, "b"), nullptr);
  EXPECT_EQ(json_text(*find(value, "b")), R"("text")");
  EXPECT_EQ(find(value, "c"), nullptr);
  EXPECT_EQ(find(Value(1.0), "a"), nullptr);
}

TEST(Object, KeepsTheOrderAndOneMemberAKey) {
  Object object{{"a", 1}, {"b", 2}};
  set(object, "a", 3);
  set(object, "c", 4);
  ASSERT_EQ(object.size(), 3U);
  EXPECT_EQ(object[0].key, "a");
  EXPECT_EQ(json_text(object[0].value), "3");
  EXPECT_EQ(object[2].key, "c");
}

TEST(InUnit, LeavesNothingNothing) {
  EXPECT_EQ(json_text(in_unit(std::nullopt, 1e-3)), "null");
  EXPECT_EQ(json_text(in_unit(0.25, 1e-3)), "250");
  EXPECT_EQ(json_text(all_in_unit(std::vector{0.5, 1.0}, 0.5)), "[1, 2]");
}

TEST(AloneOrList, HasNoListOfOne) {
  EXPECT_EQ(json_text(alone_or_list({Value(1.0)})), "1");
  EXPECT_EQ(json_text(alone_or_list({Value(1.0), Value(2.0)})), "[1, 2]");
}

}  // namespace trochoid::results::value_test
