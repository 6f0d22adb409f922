#include <trochoid/sweep/rows.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace trochoid::sweep::samples_test {

using cases::EvenValues;
using cases::ListedValues;
using cases::NormalValues;
using cases::Sweep;
using cases::SweepMethod;

double number(const cases::Node& node) {
  return std::get<double>(node.value);
}

std::vector<double> column(const Sweep& sweep, std::size_t key) {
  const Samples samples(sweep);
  std::vector<double> values;
  for (std::size_t i = 0; i < samples.rows(); ++i) {
    values.push_back(number(samples.row(i)[key]));
  }
  return values;
}

TEST(Samples, OfAGridAreAllCombinationsTheLastKeyFastest) {
  const ListedValues two{{{.value = 5.0, .where = {}}, {.value = 7.0, .where = {}}}};
  const Sweep sweep{.over = {{.key = "a", .where = {}, .values = EvenValues{1, 3, 3}},
                             {.key = "b", .where = {}, .values = two}},
                    .rows = 6};
  EXPECT_EQ(column(sweep, 0), (std::vector<double>{1, 1, 2, 2, 3, 3}));
  EXPECT_EQ(column(sweep, 1), (std::vector<double>{5, 7, 5, 7, 5, 7}));
}

TEST(Samples, EndWhereTheySayExactly) {
  const Sweep sweep{
      .over = {{.key = "a", .where = {}, .values = EvenValues{0.1, 0.7, 7}}},
      .rows = 7};
  EXPECT_EQ(column(sweep, 0).front(), 0.1);
  EXPECT_EQ(column(sweep, 0).back(), 0.7);
}

TEST(Samples, OfAListGoThroughAllKeysTogether) {
  const Sweep sweep{.over = {{.key = "a", .where = {}, .values = EvenValues{1, 3, 3}},
                             {.key = "b", .where = {}, .values = EvenValues{9, 7, 3}}},
                    .method = SweepMethod::list,
                    .rows = 3};
  EXPECT_EQ(column(sweep, 0), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(column(sweep, 1), (std::vector<double>{9, 8, 7}));
}

TEST(Samples, ByChanceHaveTheMeanAndTheSpreadAskedFor) {
  for (const SweepMethod method : {SweepMethod::random, SweepMethod::latin_hypercube}) {
    const Sweep sweep{
        .over = {{.key = "a", .where = {}, .values = NormalValues{10, 2}},
                 {.key = "b", .where = {}, .values = EvenValues{1, 3, {}}}},
        .method = method,
        .seed = 4,
        .rows = 20000};
    for (std::size_t key = 0; key < 2; ++key) {
      const std::vector<double> values = column(sweep, key);
      double mean = 0.0;
      double square = 0.0;
      for (const double v : values) {
        mean += v / 20000;
      }
      for (const double v : values) {
        square += (v - mean) * (v - mean) / 20000;
      }
      EXPECT_NEAR(mean, key == 0 ? 10 : 2, key == 0 ? 0.05 : 0.015);
      EXPECT_NEAR(std::sqrt(square), key == 0 ? 2 : 1 / std::sqrt(3), 0.03);
    }
  }
}

TEST(Samples, OfAHypercubeHitEveryStretchOnce) {
  const Sweep sweep{.over = {{.key = "a", .where = {}, .values = EvenValues{0, 1, {}}},
                             {.key = "b", .where = {}, .values = EvenValues{0, 1, {}}}},
                    .method = SweepMethod::latin_hypercube,
                    .rows = 50};
  for (const std::size_t key : {std::size_t{0}, std::size_t{1}}) {
    std::vector<double> values = column(sweep, key);
    EXPECT_FALSE(std::ranges::is_sorted(values));
    std::ranges::sort(values);
    for (std::size_t i = 0; i < 50; ++i) {
      EXPECT_EQ(std::floor(values[i] * 50), static_cast<double>(i));
    }
  }
  EXPECT_NE(column(sweep, 0), column(sweep, 1));
}

TEST(Samples, AreThoseOfTheSeed) {
  Sweep sweep{.over = {{.key = "a", .where = {}, .values = NormalValues{0, 1}}},
              .method = SweepMethod::random,
              .rows = 10};
  const auto first = column(sweep, 0);
  EXPECT_EQ(first, column(sweep, 0));
  sweep.seed = 2;
  EXPECT_NE(first, column(sweep, 0));
}

}  // namespace trochoid::sweep::samples_test
