#include <trochoid/numerics/lagrange.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trochoid::numerics::lagrange_test {

double cubic(double x) {
  return 3.0 - x + 0.5 * x * x - 2.0 * x * x * x;
}

std::vector<double> at_points(const LagrangeBasis& basis, double (*f)(double)) {
  std::vector<double> values;
  for (const double x : basis.points()) values.push_back(f(x));
  return values;
}

TEST(Lagrange, PointsAreChebyshevAndAscend) {
  const LagrangeBasis basis(2.0, 6.0, 3);
  ASSERT_EQ(basis.size(), 3U);
  EXPECT_NEAR(basis.points()[0], 4 - 2 * std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(basis.points()[1], 4.0, 1e-15);
  EXPECT_NEAR(basis.points()[2], 4 + 2 * std::sqrt(0.75), 1e-15);
}

TEST(Lagrange, ACubicThroughFourPointsIsItself) {
  const LagrangeBasis basis(-1.0, 2.5, 4);
  const auto values = at_points(basis, cubic);
  for (double x = -1.2; x < 2.7; x += 0.0731) {
    EXPECT_NEAR(basis.value(values, x), cubic(x), 1e-13) << x;
  }
}

TEST(Lagrange, WeightsAreOneInTheirPointAndZeroInTheOthers) {
  const LagrangeBasis basis(0.0, 3e-3, 7);
  std::vector<double> w(7);
  for (std::size_t i = 0; i < 7; ++i) {
    basis.weights(basis.points()[i], w);
    for (std::size_t k = 0; k < 7; ++k) EXPECT_EQ(w[k], i == k ? 1.0 : 0.0);
  }
}

TEST(Lagrange, WeightsAddUpToOneAndGiveTheValue) {
  const LagrangeBasis basis(-1.0, 2.5, 9);
  const auto values = at_points(basis, [](double x) { return std::exp(-x); });
  std::vector<double> w(9);
  for (double x = -1.0; x < 2.5; x += 0.0917) {
    basis.weights(x, w);
    double sum = 0.0;
    double value = 0.0;
    for (std::size_t k = 0; k < 9; ++k) {
      sum += w[k];
      value += w[k] * values[k];
    }
    EXPECT_NEAR(sum, 1.0, 1e-14);
    EXPECT_NEAR(value, basis.value(values, x), 1e-14);
    EXPECT_NEAR(value, std::exp(-x), 5e-6);  // 2 e (3.5/4)^9/9!
  }
}

TEST(Lagrange, AValueInAPointIsThatValueExactly) {
  const LagrangeBasis basis(0.0, 1.0, 5);
  const std::vector<double> values = {0.1, 0.7, -3.0, 1e9, 2.0};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(basis.value(values, basis.points()[i]), values[i]);
  }
}

TEST(Lagrange, ItsSeriesIsTheSamePolynomial) {
  const LagrangeBasis basis(-1.0, 2.5, 9);
  const auto values = at_points(basis, [](double x) { return std::exp(-x); });
  std::vector<double> series(9);
  basis.series(values, series);
  for (double x = -1.1; x < 2.6; x += 0.0917) {
    EXPECT_NEAR(basis.series_value(series, x), basis.value(values, x), 1e-13) << x;
  }
  const LagrangeBasis one(0.0, 2.0, 1);
  one.series(std::vector{5.0}, std::span(series).first(1));
  EXPECT_DOUBLE_EQ(one.series_value(std::span(series).first(1), 0.7), 5.0);
}

TEST(Lagrange, OnePointIsAConstant) {
  const LagrangeBasis basis(0.0, 2.0, 1);
  const std::vector<double> values = {5.0};
  EXPECT_EQ(basis.value(values, 1.0), 5.0);
  EXPECT_DOUBLE_EQ(basis.value(values, 0.3), 5.0);
}

}  // namespace trochoid::numerics::lagrange_test
