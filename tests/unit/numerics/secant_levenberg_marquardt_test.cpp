#include <gtest/gtest.h>
#include <trochoid/numerics/secant_levenberg_marquardt.h>

#include <cmath>

namespace trochoid::numerics::secant_levenberg_marquardt_test {

/// Counts what a fit asks for.
struct Asked {
  int values = 0;
  int jacobians = 0;
};

/// Exponential decay with a rate and a height, sampled with a ripple that no p explains.
Residuals decay(Asked& asked) {
  return [&asked](std::span<const double> p, std::span<double> r,
                  std::span<double> jacobian) {
    if (p[0] < -5.0) return false;
    ++asked.values;
    for (std::size_t i = 0; i < r.size(); ++i) {
      const double t = 0.05 * static_cast<double>(i);
      const double e = std::exp(-p[0] * t);
      r[i] = p[1] * e - 2.0 * std::exp(-0.7 * t) - 0.01 * std::sin(40.0 * t);
      if (jacobian.empty()) continue;
      jacobian[i] = -t * p[1] * e;
      jacobian[r.size() + i] = e;
    }
    if (!jacobian.empty()) ++asked.jacobians;
    return true;
  };
}

TEST(SecantLevenbergMarquardt, FindsTheSameWithFewerJacobians) {
  Asked few;
  Asked many;
  const auto found = secant_levenberg_marquardt(decay(few), 60, {1.5, 1.0}, {});
  const auto exact = levenberg_marquardt(decay(many), 60, {1.5, 1.0}, {});
  ASSERT_TRUE(found.converged) << found.reason;
  EXPECT_NEAR(found.p[0], exact.p[0], 1e-8);
  EXPECT_NEAR(found.p[1], exact.p[1], 1e-8);
  EXPECT_NEAR(found.final_cost, exact.final_cost, 1e-12);
  EXPECT_LE(2 * few.jacobians, many.jacobians);
}

TEST(SecantLevenbergMarquardt, StopsWhereStepsAreSmallAgainstTheNoise) {
  Asked all;
  Asked some;
  LevenbergMarquardtOptions options;
  const auto exact = secant_levenberg_marquardt(decay(all), 60, {1.5, 1.0}, options);
  options.standard_errors = 0.01;
  const auto found = secant_levenberg_marquardt(decay(some), 60, {1.5, 1.0}, options);
  ASSERT_TRUE(found.converged) << found.reason;
  EXPECT_LT(some.values, all.values);
  EXPECT_LT(found.final_cost, exact.final_cost * (1.0 + 1e-4 / 58.0));
}

TEST(SecantLevenbergMarquardt, SaysWhyThereIsNoStart) {
  Asked asked;
  const auto lost = secant_levenberg_marquardt(decay(asked), 60, {-9.0, 1.0}, {});
  EXPECT_FALSE(lost.converged);
  EXPECT_EQ(lost.reason, "the residuals cannot be evaluated at the start");
  EXPECT_EQ(lost.p[0], -9.0);
}

}  // namespace trochoid::numerics::secant_levenberg_marquardt_test
