#include <trochoid/surface/row_fit.h>

#include <gtest/gtest.h>

#include <span>
#include <vector>

namespace trochoid::surface::row_fit_test {

constexpr std::size_t rows = 40;

double x_of(std::size_t row) {
  return -1.0 + 2.0 * static_cast<double>(row) / (rows - 1);
}

/// a + b x, as measured with an alternating error of 0.01.
struct Line {
  std::vector<double> error;
  std::vector<double> count = std::vector<double>(rows, 1.0);

  Line(double a, double b) {
    for (std::size_t i = 0; i < rows; ++i) {
      error.push_back(a + b * x_of(i) + (i % 2 == 0 ? 0.01 : -0.01));
    }
  }
  [[nodiscard]] RowProblem problem() const {
    return {
        .error = error, .count = count, .independent = rows, .scatter = {.s2 = 1e-4}};
  }
};

/// How often a model was asked, and how often for its slopes.
struct Asked {
  int values = 0;
  int slopes = 0;
};

/// The line, with slopes that are `share` of the true ones.
RowModel line_model(Asked& asked, double share) {
  return [&asked, share](std::span<const double> p, std::span<const double>) {
    ++asked.values;
    Linearised at;
    for (std::size_t i = 0; i < rows; ++i) {
      at.f.push_back(p[0] + p[1] * x_of(i));
    }
    at.slopes = [&asked, share] {
      ++asked.slopes;
      std::vector<double> J;
      for (std::size_t i = 0; i < rows; ++i) {
        J.insert(J.end(), {share, share * x_of(i)});
      }
      return J;
    };
    return at;
  };
}

TEST(FitRows, FindsALineAndHowWellItIsKnown) {
  const Line line(0.3, -2.0);
  Asked asked;
  const RowFit fit = fit_rows(line.problem(), line_model(asked, 1.0), {0.0, 0.0});
  ASSERT_TRUE(fit.ok);
  EXPECT_NEAR(fit.p[0], 0.3, 1e-3);
  EXPECT_NEAR(fit.p[1], -2.0, 2e-3);
  EXPECT_NEAR(fit.cost, rows, 0.1);
  EXPECT_NEAR(fit.covariance[0], 1e-4 / rows, 1e-9);
}

/// Slopes cost many values each: where a step is not taken they are not asked for.
TEST(FitRows, AsksForSlopesOnlyWhereItGoesOnFrom) {
  const Line line(0.3, -2.0);
  Asked asked;
  // Steps are 2.5 times too long: the first ones lead uphill.
  const RowFit fit = fit_rows(line.problem(), line_model(asked, 0.4), {0.0, 0.0});
  ASSERT_TRUE(fit.ok);
  EXPECT_NEAR(fit.p[1], -2.0, 0.05);
  EXPECT_LT(asked.slopes, asked.values);
}

/// Once a step gains next to nothing the floor of the valley is reached, whatever
/// slopes over a distance promise beyond.
TEST(FitRows, EndsWhereAStepGainsNothing) {
  const Line line(0.3, -2.0);
  Asked asked;
  // Slopes ten times too steep: each step is a tenth of what it should be.
  const RowFit fit = fit_rows(line.problem(), line_model(asked, 10.0), {0.302, -2.0});
  ASSERT_TRUE(fit.ok);
  EXPECT_NEAR(fit.p[0], 0.3, 5e-4);
  EXPECT_LE(asked.values, 20);
}

/// Two unknowns that nearly make up for one another: a x + b (x + 0.05 x^3).
std::vector<double> valley(std::span<const double> p) {
  std::vector<double> f;
  for (std::size_t i = 0; i < rows; ++i) {
    const double x = x_of(i);
    f.push_back(p[0] * x + p[1] * (x + 0.05 * x * x * x));
  }
  return f;
}

/// @param error  of the slope by b, larger than what tells b from a
RowModel valley_model(double error) {
  return [error](std::span<const double> p, std::span<const double>) {
    Linearised at{.f = valley(p), .slopes = {}};
    at.slopes = [error] {
      std::vector<double> J;
      for (std::size_t i = 0; i < rows; ++i) {
        const double x = x_of(i);
        J.insert(J.end(), {x, x + 0.05 * x * x * x + (i % 3 == 0 ? error : -error)});
      }
      return J;
    };
    return at;
  };
}

TEST(FitAlongErrors, WrongSlopesAreNoKnowledge) {  // [E-27]
  const Line line(0.0, 1.0);                       // a = 1, b = 0
  const RowProblem problem = line.problem();
  const RowFit right = fit_rows(problem, valley_model(0.0), {0.0, 0.0});
  const RowFit wrong = fit_rows(problem, valley_model(0.03), {0.0, 0.0});
  ASSERT_TRUE(right.ok && wrong.ok);
  EXPECT_LT(wrong.covariance[3], 0.5 * right.covariance[3]);
  const RowFit fit = fit_along_errors(problem, valley, wrong);
  ASSERT_TRUE(fit.ok);
  EXPECT_NEAR(fit.covariance[3], right.covariance[3], 0.01 * right.covariance[3]);
  EXPECT_NEAR(fit.cost, right.cost, 1e-2);
}

TEST(FitAlongErrors, StaysWhereTheModelHasNoAnswer) {  // [E-27]
  const Line line(0.0, 1.0);
  const RowFit fit = fit_rows(line.problem(), valley_model(0.0), {0.0, 0.0});
  const RowFit same = fit_along_errors(
      line.problem(), [](std::span<const double>) { return std::vector<double>(); },
      fit);
  EXPECT_EQ(same.p, fit.p);
  EXPECT_EQ(same.covariance, fit.covariance);
}

}  // namespace trochoid::surface::row_fit_test
