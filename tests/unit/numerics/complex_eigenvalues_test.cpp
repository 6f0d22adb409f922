#include <trochoid/numerics/complex_eigenvalues.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace trochoid::numerics::complex_eigenvalues_test {

using Complex = std::complex<double>;
using Matrix = std::vector<Complex>;  ///< column-major

Matrix random_matrix(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Matrix A;
  for (std::size_t i = 0; i < n * n; ++i)
    A.emplace_back(normal(random), normal(random));
  return A;
}

/// Eigenvalues are the values of the polynomial with the first column at the roots of one.
Matrix circulant(const std::vector<Complex>& column) {
  const std::size_t n = column.size();
  Matrix A(n * n);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n; ++i) A[j * n + i] = column[(i + n - j) % n];
  }
  return A;
}

/// Farthest of the values expected from the nearest one found.
double farthest(const std::vector<Complex>& expected,
                const std::vector<Complex>& found) {
  double most = expected.size() == found.size() ? 0.0 : INFINITY;
  for (const Complex& e : expected) {
    double least = INFINITY;
    for (const Complex& f : found) least = std::min(least, std::abs(e - f));
    most = std::max(most, least);
  }
  return most;
}

TEST(ComplexEigenvalues, AreThoseOfACirculantMatrix) {
  for (const std::size_t n : {1U, 2U, 3U, 8U, 13U, 36U}) {
    const Matrix column = random_matrix(n, 7);
    const std::vector<Complex> c(column.begin(), column.begin() + static_cast<long>(n));
    std::vector<Complex> expected;
    for (std::size_t k = 0; k < n; ++k) {
      Complex sum = 0.0;
      for (std::size_t j = 0; j < n; ++j) {
        const double turns = static_cast<double>(k * j) / static_cast<double>(n);
        sum += c[j] * std::polar(1.0, 2 * std::numbers::pi * turns);
      }
      expected.push_back(sum);
    }
    EXPECT_LT(farthest(expected, complex_eigenvalues(circulant(c), n)),
              1e-12 * static_cast<double>(n))
        << n;
  }
}

TEST(ComplexEigenvalues, SumUpToTheTraceOfEachPower) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const std::size_t n = 1 + seed % 30;
    Matrix A = random_matrix(n, seed);
    for (std::size_t j = 0; j < n; ++j) {  // columns from 1e-4 to 1
      for (std::size_t i = 0; i < n; ++i)
        A[j * n + i] *=
            std::pow(1e-4, static_cast<double>(j * 7 % n) / static_cast<double>(n));
    }
    Complex trace = 0.0;
    Complex trace_of_square = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      trace += A[i * n + i];
      for (std::size_t j = 0; j < n; ++j)
        trace_of_square += A[i * n + j] * A[j * n + i];
    }
    for (const Complex& lambda : complex_eigenvalues(A, n)) {
      trace -= lambda;
      trace_of_square -= lambda * lambda;
    }
    EXPECT_LT(std::abs(trace), 1e-12 * static_cast<double>(n)) << seed;
    EXPECT_LT(std::abs(trace_of_square), 1e-11 * static_cast<double>(n)) << seed;
  }
}

/// No shift by the last two rows leads out of a cycle.
TEST(ComplexEigenvalues, OfACycleAreTheRootsOfOne) {
  for (const std::size_t n : {2U, 3U, 4U, 5U, 6U, 12U}) {
    std::vector<Complex> step(n);
    step[1] = 1.0;
    std::vector<Complex> roots;
    for (std::size_t k = 0; k < n; ++k) {
      roots.push_back(std::polar(
          1.0, 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n)));
    }
    EXPECT_LT(farthest(roots, complex_eigenvalues(circulant(step), n)), 1e-13) << n;
  }
}

TEST(ComplexEigenvalues, OfTrianglesAndZeros) {
  const std::size_t n = 6;
  Matrix A(n * n);
  EXPECT_EQ(complex_eigenvalues(A, n), std::vector<Complex>(n));
  Matrix jordan(n * n);  // its eigenvalue is known to a sixth root of the rounding only
  for (std::size_t i = 0; i < n; ++i) jordan[i * n + i] = 2.0;
  for (std::size_t i = 1; i < n; ++i) jordan[i * n + i - 1] = 1.0;
  EXPECT_LT(farthest(std::vector<Complex>(n, 2.0), complex_eigenvalues(jordan, n)),
            1e-2);
  std::vector<Complex> diagonal;
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i <= j; ++i)
      A[j * n + i] = {1.0 + static_cast<double>(i), 2.0 - static_cast<double>(j)};
    diagonal.push_back(A[j * n + j]);
  }
  EXPECT_LT(farthest(diagonal, complex_eigenvalues(A, n)), 1e-12);
}

TEST(EigenvalueBound, IsNotExceeded) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const std::size_t n = 1 + seed % 12;
    const Matrix A = random_matrix(n, seed);
    const double bound = eigenvalue_bound(A, n);
    for (const Complex& lambda : complex_eigenvalues(A, n)) {
      EXPECT_LE(std::abs(lambda), bound * (1 + 1e-12));
    }
  }
}

}  // namespace trochoid::numerics::complex_eigenvalues_test
