#include <gtest/gtest.h>
#include <trochoid/numerics/dense.h>
#include <trochoid/numerics/padded.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace trochoid::numerics::padded_test {

/// Chaotic: no two alike.
class Numbers {
 public:
  double next() {
    x_ = 3.9 * x_ * (1 - x_);
    return x_ - 0.5;
  }

 private:
  double x_ = 0.3;
};

PaddedMatrix padded_copy(const Matrix& A) {
  PaddedMatrix out = padded_zeros(A.rows, A.columns);
  for (std::size_t j = 0; j < A.columns; ++j) {
    for (std::size_t i = 0; i < A.rows; ++i) out.column(j)[i] = A(i, j);
  }
  return out;
}

Matrix some_matrix(std::size_t rows, std::size_t columns) {
  Matrix A = zeros(rows, columns);
  Numbers numbers;
  for (double& value : A.values) value = numbers.next();
  return A;
}

TEST(Padded, ProductsAreThoseOfPlainMatrices) {
  for (const std::size_t rows : {1U, 7U, 8U, 19U, 30U, 65U}) {
    for (const std::size_t columns : {1U, 2U, 5U, 36U}) {
      const Matrix A = some_matrix(rows, columns);
      const PaddedMatrix padded_A = padded_copy(A);
      const Matrix x = some_matrix(columns, 1);
      std::vector<double> wanted(rows);
      add_product(1.0, A.values, x.values, wanted);
      std::vector<double> y(padded(rows), 3.0);
      padded_product(padded_A.values, x.values, y);
      std::vector<double> zero = y;
      subtract_padded_product(padded_A.values, x.values, zero);
      std::vector<double> z(columns);
      padded_transposed_product(padded_A.values, y, z);
      std::vector<double> wanted_z(columns);
      transposed_product(A.values, wanted, wanted_z);
      for (std::size_t i = 0; i < y.size(); ++i) {
        EXPECT_NEAR(y[i], i < rows ? wanted[i] : 0.0, 1e-14) << rows << ' ' << columns;
        EXPECT_NEAR(zero[i], 0.0, 1e-14);
      }
      for (std::size_t j = 0; j < columns; ++j) EXPECT_NEAR(z[j], wanted_z[j], 1e-12);
    }
  }
}

TEST(Padded, EliminationSolvesForAllRightSides) {
  for (const std::size_t n : {1U, 2U, 5U, 8U, 23U, 42U}) {
    Matrix A = some_matrix(n, n);
    A(0, 0) = 0.0;  // the first pivot: rows must be exchanged
    if (n == 1) A(0, 0) = 2.0;
    const Matrix B = some_matrix(n, 3);
    PaddedMatrix both = padded_copy(A);
    both.columns += B.columns;
    const PaddedMatrix right = padded_copy(B);
    both.values.insert(both.values.end(), right.values.begin(), right.values.end());
    std::vector<double> room(2 * both.columns);
    eliminate(both, room);
    const Lu factors = lu(A);
    std::vector<double> wanted(n);
    for (std::size_t j = 0; j < B.columns; ++j) {
      solve(factors, std::span(B.values).subspan(j * n, n), wanted);
      const double size = std::abs(*std::max_element(
          wanted.begin(), wanted.end(),
          [](double a, double b) { return std::abs(a) < std::abs(b); }));
      for (std::size_t i = 0; i < n; ++i) {
        EXPECT_NEAR(both.column(n + j)[i], wanted[i], 1e-11 * size) << n;
      }
    }
  }
}

TEST(Padded, EliminationOfASingularMatrixIsNotFinite) {
  PaddedMatrix both = padded_zeros(4, 5);
  for (std::size_t i = 0; i < 4; ++i) both.column(4)[i] = 1.0;
  std::vector<double> room(2 * both.columns);
  eliminate(both, room);
  EXPECT_FALSE(std::isfinite(both.column(4)[0]));
}

}  // namespace trochoid::numerics::padded_test
