#include <gtest/gtest.h>
#include <trochoid/numerics/least_squares.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace trochoid::numerics::least_squares_test {

TEST(LeastSquares, LineThroughThreePoints) {  // [I-1]
  // y = 1 + 2 t at t = 0, 1, 2, the middle point lifted by 3: by hand, a = 2, b = 2.
  const std::vector<double> A = {1, 0, 1, 1, 1, 2};
  const std::vector<double> b = {1, 6, 5};
  const LeastSquares fit = least_squares(A, 2, b, 1e-12);
  EXPECT_NEAR(fit.x[0], 2.0, 1e-13);
  EXPECT_NEAR(fit.x[1], 2.0, 1e-13);
  EXPECT_NEAR(fit.rss, 6.0, 1e-12);
  EXPECT_EQ(fit.rank, 2);
  // (A^T A)^-1 = [3 3; 3 5]^-1
  EXPECT_NEAR(fit.inverse_gram[0], 5.0 / 6.0, 1e-13);
  EXPECT_NEAR(fit.inverse_gram[1], -0.5, 1e-13);
  EXPECT_NEAR(fit.inverse_gram[3], 0.5, 1e-13);
  // Unit columns with cosine 3/sqrt(15): singular values sqrt(1 +- cos).
  const double cosine = 3.0 / std::sqrt(15.0);
  EXPECT_NEAR(fit.condition, std::sqrt((1 + cosine) / (1 - cosine)), 1e-12);
}

TEST(LeastSquares, ConditionDoesNotDependOnUnits) {  // [I-6]
  const std::vector<double> b = {1, 6, 5};
  const std::vector<double> A = {1, 0, 1, 1, 1, 2};
  std::vector<double> other = A;
  for (std::size_t i = 1; i < other.size(); i += 2) other[i] *= 1e9;
  EXPECT_NEAR(least_squares(A, 2, b, 1e-12).condition,
              least_squares(other, 2, b, 1e-12).condition, 1e-9);
}

TEST(LeastSquares, DependentColumnsAreSeenAndNamed) {  // [I-6]
  std::vector<double> A;
  std::vector<double> b;
  for (int i = 0; i < 20; ++i) {
    const double t = 0.3 * i;
    A.insert(A.end(), {std::sin(t), std::cos(t), 1e6 * (std::sin(t) + std::cos(t)), t});
    b.push_back(t);
  }
  const LeastSquares fit = least_squares(A, 4, b, 1e-10);
  EXPECT_EQ(fit.rank, 3);
  EXPECT_TRUE(fit.inverse_gram.empty());
  ASSERT_EQ(fit.null_space.size(), 4U);
  EXPECT_GT(std::abs(fit.null_space[0]), 0.1);
  EXPECT_GT(std::abs(fit.null_space[2]), 0.1);
  EXPECT_LT(std::abs(fit.null_space[3]), 1e-9);
  EXPECT_LT(fit.rss, 1e-20);
}

TEST(LeastSquares, ZeroColumnAndTooFewRowsHaveNoFullRank) {  // [I-6]
  EXPECT_EQ(least_squares(std::vector<double>{1, 0, 2, 0}, 2, std::vector<double>{1, 2},
                          1e-10)
                .rank,
            1);
  EXPECT_EQ(
      least_squares(std::vector<double>{1, 2}, 2, std::vector<double>{1}, 1e-10).rank,
      1);
}

TEST(LeastSquares, WrongShapesAreRefused) {
  EXPECT_THROW(
      least_squares(std::vector<double>(5), 2, std::vector<double>{1, 2}, 1e-10),
      std::invalid_argument);
}

TEST(LeastSquares, ProjectionLeavesWhatIsOrthogonal) {  // [I-1]
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const int m = 50;
  std::vector<double> A(m * 3);
  std::vector<double> B(m * 2);
  for (double& a : A) a = normal(random);
  for (double& b : B) b = normal(random);
  std::vector<double> b0(m);
  for (std::size_t i = 0; i < m; ++i) b0[i] = B[2 * i];
  const LeastSquares fit = least_squares(A, 3, b0, 1e-12);
  const std::vector<double> X = project_out(A, 3, B, 2);
  for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(X[2 * j], fit.x[j], 1e-12);
  for (std::size_t i = 0; i < m; ++i) EXPECT_NEAR(B[2 * i], fit.residual[i], 1e-12);
}

TEST(LeastSquares, OrthonormalColumnsSpanTheSame) {
  const std::vector<double> A = {1, 0, 1, 1, 1, 2};
  const std::vector<double> Q = orthonormal(A, 2, 1e-12);
  ASSERT_EQ(Q.size(), 6U);
  EXPECT_NEAR(Q[0] * Q[0] + Q[2] * Q[2] + Q[4] * Q[4], 1.0, 1e-14);
  EXPECT_NEAR(Q[0] * Q[1] + Q[2] * Q[3] + Q[4] * Q[5], 0.0, 1e-14);
  // (1, 1, 1), which A has, is what both columns have of it.
  const double first = Q[0] + Q[2] + Q[4];
  const double second = Q[1] + Q[3] + Q[5];
  EXPECT_NEAR(first * first + second * second, 3.0, 1e-14);
}

TEST(LeastSquares, OrthonormalColumnsAreAsManyAsIndependentOnes) {
  const std::vector<double> A = {1, 0, 1, 1, 1, 2, 1, 2, 3, 1, 3, 4};
  EXPECT_EQ(orthonormal(A, 3, 1e-12).size(), 8U);
}

}  // namespace trochoid::numerics::least_squares_test
