#include <gtest/gtest.h>
#include <trochoid/numerics/levenberg_marquardt.h>
#include <trochoid/numerics/student.h>

#include <cmath>
#include <stdexcept>

namespace trochoid::numerics::levenberg_marquardt_test {

TEST(LevenbergMarquardt, FindsTheMinimumOfRosenbrock) {
  const Residuals valley = [](std::span<const double> p, std::span<double> r,
                              std::span<double> jacobian) {
    r[0] = 10.0 * (p[1] - p[0] * p[0]);
    r[1] = 1.0 - p[0];
    if (!jacobian.empty()) {
      jacobian[0] = -20.0 * p[0];
      jacobian[1] = -1.0;
      jacobian[2] = 10.0;
      jacobian[3] = 0.0;
    }
    return true;
  };
  const auto summary = levenberg_marquardt(valley, 2, {-1.2, 1.0}, {});
  EXPECT_TRUE(summary.converged) << summary.reason;
  EXPECT_NEAR(summary.p[0], 1.0, 1e-10);
  EXPECT_NEAR(summary.p[1], 1.0, 1e-10);
  EXPECT_NEAR(summary.initial_cost, 12.1, 1e-12);
}

TEST(LevenbergMarquardt, TurnsBackWhereThereIsNoValue) {
  const Residuals log_minus_one = [](std::span<const double> p, std::span<double> r,
                                     std::span<double> jacobian) {
    if (!(p[0] > 0.0)) return false;
    r[0] = std::log(p[0]) - 1.0;
    if (!jacobian.empty()) jacobian[0] = 1.0 / p[0];
    return true;
  };
  const auto summary = levenberg_marquardt(log_minus_one, 1, {20.0}, {});
  EXPECT_TRUE(summary.converged) << summary.reason;
  EXPECT_NEAR(summary.p[0], std::exp(1.0), 1e-9);
  const auto lost = levenberg_marquardt(log_minus_one, 1, {-1.0}, {});
  EXPECT_FALSE(lost.converged);
  EXPECT_EQ(lost.p[0], -1.0);
}

TEST(LevenbergMarquardt, SaysWhenTheLimitWasReached) {
  const Residuals parabola = [](std::span<const double> p, std::span<double> r,
                                std::span<double> jacobian) {
    r[0] = p[0] * p[0] + 1.0;
    if (!jacobian.empty()) jacobian[0] = 2.0 * p[0];
    return true;
  };
  LevenbergMarquardtOptions options;
  options.max_iterations = 2;
  const auto summary = levenberg_marquardt(parabola, 1, {3.0}, options);
  EXPECT_FALSE(summary.converged);
  EXPECT_NE(summary.reason.find("limit"), std::string::npos);
}

TEST(Student, QuantilesOfTheTables) {  // [I-8]
  EXPECT_NEAR(student_t(0.975, 1), 12.7062047361747, 1e-10);
  EXPECT_NEAR(student_t(0.975, 10), 2.22813885198627, 1e-12);
  EXPECT_NEAR(student_t(0.975, 1e9), 1.95996398454005, 1e-8);
  EXPECT_THROW(student_t(0.975, 0), std::domain_error);
}

}  // namespace trochoid::numerics::levenberg_marquardt_test
