#include <gtest/gtest.h>
#include <trochoid/numerics/combinations.h>
#include <trochoid/numerics/least_squares.h>

#include <random>

namespace trochoid::numerics::combinations_test {

constexpr double rank_tolerance = 1e-8;

std::vector<double> random_matrix(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> out(size);
  for (double& x : out) x = normal(random);
  return out;
}

/// A = C B: what is known of x is B x, whatever C.
TEST(Combinations, FindWhatARankDeficientMatrixTells) {  // [I-26]
  // x_0 + 2 x_1, x_2 and x_3 - 1000 x_4 are told, nothing of x_5.
  const std::vector<double> B{1, 2, 0, 0, 0,     0,  //
                              0, 0, 1, 0, 0,     0,  //
                              0, 0, 0, 1, -1000, 0};
  const auto C = random_matrix(20 * 3, 3);
  std::vector<double> A(20 * 6, 0.0);
  const std::vector<double> x{3, 5, -2, 7, 0.01, 11};
  std::vector<double> b(20, 0.0);
  for (std::size_t i = 0; i < 20; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t j = 0; j < 6; ++j) A[6 * i + j] += C[3 * i + k] * B[6 * k + j];
    }
    for (std::size_t j = 0; j < 6; ++j) b[i] += A[6 * i + j] * x[j];
  }
  const Combinations known = known_combinations(A, 6, b, rank_tolerance);
  ASSERT_EQ(known.pivots, (std::vector<std::size_t>{0, 2, 3}));
  for (std::size_t k = 0; k < B.size(); ++k) {
    EXPECT_NEAR(known.weights[k], B[k], 1e-9 * std::max(1.0, std::abs(B[k])));
  }
  EXPECT_FALSE(known.alone(0));
  EXPECT_TRUE(known.alone(1));
  EXPECT_NEAR(known.value[0], 13.0, 1e-10);
  EXPECT_NEAR(known.value[1], -2.0, 1e-10);
  EXPECT_NEAR(known.value[2], -3.0, 1e-10);
  EXPECT_LT(known.rss, 1e-20);
  const LeastSquares reduced = least_squares(C, 3, b, rank_tolerance);
  for (std::size_t k = 0; k < 9; ++k) {
    EXPECT_NEAR(known.covariance[k], reduced.inverse_gram[k], 1e-12);
  }
}

TEST(Combinations, OfAFullMatrixAreTheUnknowns) {  // [I-26]
  const auto A = random_matrix(30 * 4, 5);
  const auto b = random_matrix(30, 6);
  const Combinations known = known_combinations(A, 4, b, rank_tolerance);
  const LeastSquares all = least_squares(A, 4, b, rank_tolerance);
  ASSERT_EQ(known.rank(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_TRUE(known.alone(k));
    EXPECT_NEAR(known.x[k], all.x[k], 1e-12);
  }
  EXPECT_NEAR(known.condition, all.condition, 1e-9 * all.condition);
}

TEST(Combinations, OfZerosAreNone) {
  const Combinations known = known_combinations(std::vector<double>(12, 0.0), 3,
                                                std::vector<double>(4, 1.0), 1e-8);
  EXPECT_EQ(known.rank(), 0U);
  EXPECT_DOUBLE_EQ(known.rss, 4.0);
}

}  // namespace trochoid::numerics::combinations_test
