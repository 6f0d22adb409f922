#include <gtest/gtest.h>
#include <trochoid/numerics/columns.h>
#include <trochoid/numerics/least_squares.h>

#include <random>
#include <vector>

namespace trochoid::numerics::columns_test {

std::vector<double> random_numbers(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> out(count);
  for (double& v : out) v = normal(random);
  return out;
}

std::vector<double> by_rows(const Columns& A) {
  std::vector<double> out;
  for (std::size_t i = 0; i < A.rows; ++i) {
    for (std::size_t c = 0; c < A.count(); ++c) out.push_back(A[c][i]);
  }
  return out;
}

/// Whatever is left over beside whole vectors and pairs of columns.
TEST(Columns, ProductsAndCombinationsAreTheSums) {
  for (const std::size_t rows : {1U, 7U, 300U, 515U}) {
    for (const std::size_t n : {1U, 2U, 5U, 6U}) {
      const std::vector<double> a = random_numbers(n * rows, 1);
      const std::vector<double> b = random_numbers(3 * rows, 2);
      const Columns A{a, rows};
      const Columns B{b, rows};
      std::vector<double> products(n * 3);
      inner_products(A, B, products);
      const std::vector<double> gram = gram_of(A);
      std::vector<double> combined(b.begin(), b.begin() + static_cast<long>(rows));
      const std::vector<double> x = random_numbers(n, 3);
      add_combination(A, x, -2.0, combined);
      for (std::size_t c = 0; c < n; ++c) {
        for (std::size_t k = 0; k < 3; ++k) {
          double sum = 0.0;
          for (std::size_t i = 0; i < rows; ++i) sum += A[c][i] * B[k][i];
          EXPECT_NEAR(products[c * 3 + k], sum, 1e-11);
        }
        for (std::size_t k = 0; k < n; ++k) {
          double sum = 0.0;
          for (std::size_t i = 0; i < rows; ++i) sum += A[c][i] * A[k][i];
          EXPECT_NEAR(gram[c * n + k], sum, 1e-11);
        }
      }
      for (std::size_t i = 0; i < rows; ++i) {
        double sum = b[i];
        for (std::size_t c = 0; c < n; ++c) sum -= 2.0 * x[c] * A[c][i];
        EXPECT_NEAR(combined[i], sum, 1e-12);
      }
    }
  }
}

/// Well or badly conditioned, or not independent at all.
TEST(Columns, LeastSquaresAreThoseOfTheRows) {  // [I-1] [I-6]
  const std::size_t rows = 40;
  for (const double apart : {1.0, 1e-5, 0.0}) {
    std::vector<double> a = random_numbers(3 * rows, 4);
    for (std::size_t i = 0; i < rows; ++i) {
      a[2 * rows + i] = 1e3 * (a[i] + apart * a[2 * rows + i]);
    }
    const Columns A{a, rows};
    const std::vector<double> b = random_numbers(rows, 5);
    const LeastSquares fit = least_squares(A, b, 1e-10);
    const LeastSquares same = least_squares(by_rows(A), 3, b, 1e-10);
    EXPECT_EQ(fit.rank, same.rank);
    if (apart == 0.0) continue;
    EXPECT_NEAR(fit.rss, same.rss, 1e-12 * same.rss);
    EXPECT_NEAR(fit.condition, same.condition, 1e-9 * same.condition);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(fit.x[c], same.x[c], 1e-9 * std::abs(same.x[c]));
      EXPECT_NEAR(fit.norms[c], same.norms[c], 1e-12 * same.norms[c]);
      EXPECT_NEAR(fit.inverse_gram[4 * c], same.inverse_gram[4 * c],
                  1e-9 * same.inverse_gram[4 * c]);
    }
  }
}

TEST(Columns, ProjectionLeavesWhatIsOrthogonal) {  // [I-1]
  const std::size_t rows = 50;
  const std::vector<double> a = random_numbers(3 * rows, 6);
  std::vector<double> b = random_numbers(2 * rows, 7);
  const Columns A{a, rows};
  const LeastSquares fit = least_squares(by_rows(A), 3, std::span(b).last(rows), 1e-12);
  const std::vector<double> X = project_out(A, gram_of(A), b);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(X[3 + c], fit.x[c], 1e-12);
  for (std::size_t i = 0; i < rows; ++i) {
    EXPECT_NEAR(b[rows + i], fit.residual[i], 1e-12);
  }
}

}  // namespace trochoid::numerics::columns_test
