#include <trochoid/base/error.h>
#include <trochoid/results/compared.h>
#include <trochoid/results/json.h>

#include <gtest/gtest.h>

#include <string>

namespace trochoid::results::compared_test {

Object estimate(double value, double se) {
  return {{"value", value}, {"se", se}, {"low", value - 2 * se}};
}

NamedAnswer made(const std::string& name, double peak, double K) {
  Answer answer{.command = "simulate",
                .heading = {.title = "cut", .message = "so much"},
                .result = Object{{"peak_N", peak},
                                 {"mean_N", Array{1.0, 2.0}},
                                 {"coefficients", Object{{"K", estimate(K, 10)}}},
                                 {"covariance", Object{{"matrix", Array{Array{peak}}}}},
                                 {"long", Array(25, Value(peak))},
                                 {"none", Value()}}};
  answer.heading.case_toml = "title = \"" + name +
                             "\"\n[cut]\nspindle_rpm = 800\n[[mode]]\nmass_kg = 1\n"
                             "[[mode]]\nmass_kg = " +
                             name + "\n";
  answer.tables = {{"forces.csv", {{"angle_deg", {0, 1}}, {"Fx_N", {peak, peak}}}}};
  return {name, answer};
}

const Value& of(const Answer& answer, const char* key) {
  static const Value none;
  const Value result{answer.result};
  const Value* found = find(result, key);
  static Value kept;
  kept = found == nullptr ? none : *found;
  return kept;
}

TEST(Compared, SaysWhatDiffersAndByHowMuchOfWhatIsKnown) {
  const Answer both = compared(made("1", 100, 500), made("2", 150, 530));
  EXPECT_EQ(both.command, "compare");
  EXPECT_EQ(both.heading.title, "1 and 2");
  EXPECT_EQ(
      both.heading.message,
      "2 of 4 numbers differ by more than 0.1 %; most: coefficients.K from 500 to "
      "530 (2.1 standard errors).");
  EXPECT_EQ(json_text(of(both, "numbers")),
            json_text(Array{Object{{"path", "peak_N"},
                                   {"a", 100.0},
                                   {"b", 150.0},
                                   {"differs", true},
                                   {"standard_errors", Value()}},
                            Object{{"path", "mean_N[1]"},
                                   {"a", 1.0},
                                   {"b", 1.0},
                                   {"differs", false},
                                   {"standard_errors", Value()}},
                            Object{{"path", "mean_N[2]"},
                                   {"a", 2.0},
                                   {"b", 2.0},
                                   {"differs", false},
                                   {"standard_errors", Value()}},
                            Object{{"path", "coefficients.K"},
                                   {"a", 500.0},
                                   {"b", 530.0},
                                   {"differs", true},
                                   {"standard_errors", 30 / std::hypot(10.0, 10.0)}}}));
}

TEST(Compared, NamesTheInputsThatDiffer) {
  const Answer both = compared(made("1", 100, 500), made("2", 100, 500));
  EXPECT_EQ(both.heading.message,
            "All 4 numbers of the two are the same within 0.1 %.");
  EXPECT_EQ(
      json_text(of(both, "inputs")),
      json_text(Array{Object{{"key", "mode[2].mass_kg"}, {"a", "1"}, {"b", "2"}}}));
}

TEST(Compared, HasTheTablesOfBoth) {
  const Answer both = compared(made("1", 100, 500), made("2", 150, 530));
  ASSERT_EQ(both.tables.size(), 2U);
  EXPECT_EQ(both.tables[0].file, "a: forces.csv");
  EXPECT_EQ(both.tables[1].file, "b: forces.csv");
  EXPECT_EQ(both.tables[1].columns[1].values[0], 150);
}

TEST(Compared, AnswersOfTwoCommandsAreNot) {
  NamedAnswer other = made("2", 1, 1);
  other.answer.command = "identify";
  EXPECT_THROW(compared(made("1", 1, 1), other), base::InputError);
}

TEST(Compared, LeavesOutWhatOnlyRepeatsAnInput) {
  NamedAnswer a = made("1", 100, 500);
  NamedAnswer b = made("1", 100, 500);
  b.answer.heading.case_toml.replace(b.answer.heading.case_toml.find("800"), 3, "900");
  std::get<Object>(a.answer.result.data).push_back({"spindle_rpm", 800.0});
  std::get<Object>(b.answer.result.data).push_back({"spindle_rpm", 900.0});
  EXPECT_EQ(compared(a, b).heading.message,
            "All 4 numbers of the two are the same within 0.1 %.");
}

}  // namespace trochoid::results::compared_test
