#include <gtest/gtest.h>
#include <trochoid/numerics/dense.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace trochoid::numerics::dense_test {

/// From rows, as one writes it.
Matrix matrix(std::size_t n, const std::vector<double>& rows) {
  Matrix out = zeros(n, rows.size() / n);
  for (std::size_t i = 0; i < rows.size(); ++i)
    out(i / out.columns, i % out.columns) = rows[i];
  return out;
}

TEST(Dense, ProductsAreThoseByHand) {
  const Matrix A = matrix(2, {1, 2, 3, 4, 5, 6});
  std::vector<double> y = {10, 20};
  add_product(2.0, A.values, std::vector<double>{1, 0, -1}, y);
  EXPECT_EQ(y, (std::vector<double>{6, 16}));
  std::vector<double> z(3);
  transposed_product(A.values, std::vector<double>{1, -1}, z);
  EXPECT_EQ(z, (std::vector<double>{-3, -3, -3}));
}

TEST(Dense, SolutionSatisfiesTheEquations) {
  // The first pivot is 0: rows must be exchanged.
  const Matrix A = matrix(3, {0, 2, 1, 4, 1, 0, 1, 1, 1});
  std::vector<double> x(3);
  solve(lu(A), std::vector<double>{5, 6, 4}, x);
  std::vector<double> b(3);
  add_product(1.0, A.values, x, b);
  EXPECT_NEAR(b[0], 5, 1e-14);
  EXPECT_NEAR(b[1], 6, 1e-14);
  EXPECT_NEAR(b[2], 4, 1e-14);
}

TEST(Dense, ConditionOfAKnownMatrix) {
  // Inverse [-2 1; 1.5 -0.5]: |A| = 6, |A^-1| = 3.5.
  const Matrix A = matrix(2, {1, 2, 3, 4});
  EXPECT_NEAR(reciprocal_condition(A, lu(A)), 1.0 / 21.0, 1e-15);
  const Matrix singular = matrix(2, {1, 2, 2, 4});
  EXPECT_LT(reciprocal_condition(singular, lu(singular)), 1e-15);
}

TEST(Dense, PairOfAHessenbergMatrixIsThatOfAnyMatrix) {
  for (const std::size_t n : {1U, 2U, 7U, 20U}) {
    Matrix H = zeros(n, n);
    double x = 0.3;
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = 0; i < std::min(n, j + 2); ++i) {
        x = 3.9 * x * (1 - x);
        H(i, j) = x - 0.5;
      }
    }
    const Eigenpair own = largest_hessenberg_pair(H);
    EXPECT_LT(std::abs(own.value - largest_eigenpair(H).value), 1e-12);
    double length = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      std::complex<double> row = 0.0;
      for (std::size_t j = 0; j < n; ++j) row += H(i, j) * own.vector[j];
      EXPECT_LT(std::abs(row - own.value * own.vector[i]), 1e-11);
      length += std::norm(own.vector[i]);
    }
    EXPECT_NEAR(length, 1.0, 1e-12);
  }
}

TEST(Dense, EigenvaluesOfACompanionMatrix) {
  // Roots of (x - 2)(x^2 + 2 x + 5) = x^3 + x - 10.
  auto roots = eigenvalues(matrix(3, {0, -1, 10, 1, 0, 0, 0, 1, 0}));
  std::sort(roots.begin(), roots.end(),
            [](auto a, auto b) { return a.imag() < b.imag(); });
  ASSERT_EQ(roots.size(), 3U);
  EXPECT_LT(std::abs(roots[0] - std::complex<double>(-1, -2)), 1e-13);
  EXPECT_LT(std::abs(roots[1] - 2.0), 1e-13);
  EXPECT_LT(std::abs(roots[2] - std::complex<double>(-1, 2)), 1e-13);
}

TEST(Dense, LargestEigenpairIsOne) {
  for (const Matrix& A : {matrix(3, {0, -1, 10, 1, 0, 0, 0, 1, 0}),  // a complex pair
                          matrix(2, {2, 1, 1, 3})}) {
    const Eigenpair found = largest_eigenpair(A);
    double size = 0.0;
    for (std::size_t i = 0; i < A.rows; ++i) {
      std::complex<double> product;
      for (std::size_t k = 0; k < A.rows; ++k) product += A(i, k) * found.vector[k];
      EXPECT_LT(std::abs(product - found.value * found.vector[i]), 1e-14);
      size += std::norm(found.vector[i]);
    }
    EXPECT_NEAR(size, 1.0, 1e-14);
    EXPECT_GE(found.value.imag(), 0.0);
  }
}

TEST(Dense, ExponentialOfARotationAndAShear) {
  const Matrix turned = exponential(matrix(2, {0, -0.7, 0.7, 0}));
  EXPECT_NEAR(turned(0, 0), std::cos(0.7), 1e-15);
  EXPECT_NEAR(turned(1, 0), std::sin(0.7), 1e-15);
  EXPECT_NEAR(turned(0, 1), -std::sin(0.7), 1e-15);
  const Matrix sheared = exponential(matrix(2, {0, 3, 0, 0}));
  EXPECT_NEAR(sheared(0, 1), 3.0, 1e-15);
  EXPECT_NEAR(sheared(1, 0), 0.0, 1e-15);
}

}  // namespace trochoid::numerics::dense_test
