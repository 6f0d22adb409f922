#include <trochoid/results/spread.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace trochoid::results::spread_test {

std::vector<double> counted(std::size_t n) {
  std::vector<double> values(n);
  std::iota(values.begin(), values.end(), 1.0);
  return values;
}

TEST(Spread, IsThatOfTheSortedNumbers) {
  const Spread s = spread_of({3, 1, 2, 5, 4});
  EXPECT_EQ(s.min, 1);
  EXPECT_EQ(s.median, 3);
  EXPECT_EQ(s.max, 5);
  EXPECT_EQ(s.mean, 3);
  EXPECT_DOUBLE_EQ(s.sd, std::sqrt(2.5));
  EXPECT_DOUBLE_EQ(s.low, 1.1);
  EXPECT_DOUBLE_EQ(s.high, 4.9);
  EXPECT_EQ(spread_of({7}).sd, 0);
}

// The places are those of tables of the binomial distribution: P(B(200, .025) < 1) =
// .0063, P(B < 2) = .0387; P(B >= 11) = .0133, P(B >= 10) = .0322.
TEST(Spread, BoundsItsEndsByTheSortedNumbersAlone) {  // [U-7]
  const Spread s = spread_of(counted(200));
  ASSERT_TRUE(s.low_between && s.high_between);
  EXPECT_EQ(*s.low_between, (std::array<double, 2>{1, 11}));
  EXPECT_EQ(*s.high_between, (std::array<double, 2>{190, 200}));
}

TEST(Spread, OfFewNumbersHasNoBounds) {
  EXPECT_FALSE(spread_of(counted(least_for_bounds - 1)).low_between);
  EXPECT_TRUE(spread_of(counted(least_for_bounds)).low_between);
}

TEST(Spread, BoundsHoldTheTrueEndsAsOftenAsTheySay) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  int held = 0;
  for (int i = 0; i < 1000; ++i) {
    std::vector<double> values(300);
    for (double& value : values) {
      value = normal(random);
    }
    const auto ends = *spread_of(values).low_between;
    held += ends[0] <= -1.959964 && -1.959964 <= ends[1] ? 1 : 0;
  }
  EXPECT_GE(held, 940);
  EXPECT_LT(held, 995);
}

}  // namespace trochoid::results::spread_test
