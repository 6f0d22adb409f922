#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

/// Dense linear algebra behind plain functions: what is slow to compile, compiled once.
namespace trochoid::numerics {

/// @brief A dense matrix of numbers.
struct Matrix {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<double> values;  ///< column-major, shape (rows, columns)

  double& operator()(std::size_t i, std::size_t j) noexcept {
    return values[i + j * rows];
  }
  double operator()(std::size_t i, std::size_t j) const noexcept {
    return values[i + j * rows];
  }
};

/// @brief A matrix of zeros.
inline Matrix zeros(std::size_t rows, std::size_t columns) {
  return {rows, columns, std::vector<double>(rows * columns)};
}

/// @brief y += factor A x.
/// @param[in]     A  column-major, shape (y.size(), x.size())
/// @param[in,out] y  not part of x
void add_product(double factor, std::span<const double> A, std::span<const double> x,
                 std::span<double> y) noexcept;

/// @brief y = A^T x.
/// @param[in]  A  column-major, shape (x.size(), y.size())
/// @param[out] y  not part of x
void transposed_product(std::span<const double> A, std::span<const double> x,
                        std::span<double> y) noexcept;

/// @brief P A = L U of a square matrix, with the largest pivots.
struct Lu {
  Matrix factors;          ///< U, and below its diagonal L
  std::vector<int> place;  ///< of each row of A among those of P A
};

/// @param A  square; the factors of a singular one solve nothing: not finite
Lu lu(const Matrix& A);

/// @brief A x = b.
/// @param[in]  b  shape (n)
/// @param[out] x  shape (n), not part of b
void solve(const Lu& lu, std::span<const double> b, std::span<double> x) noexcept;

/// @brief 1/(|A| |A^-1|) in the norm of the largest column sum; 0 for a singular A.
double reciprocal_condition(const Matrix& A, const Lu& lu);

/// @param A  square
/// @return shape (n), in no order, but conjugate ones together
std::vector<std::complex<double>> eigenvalues(const Matrix& A);

struct Eigenpair {
  std::complex<double> value;
  std::vector<std::complex<double>> vector;  ///< of unit length, shape (n)
};

/// @brief The eigenvalue of largest modulus, its imaginary part not negative.
/// @param A  square, at least (1, 1)
Eigenpair largest_eigenpair(const Matrix& A);

/// @brief The same of a matrix without entries below its first subdiagonal, in a third
/// of the time: eigenvalues first, the vector by inverse iteration.
/// @param H  square, at least (1, 1)
Eigenpair largest_hessenberg_pair(const Matrix& H);

/// @brief e^A of a square matrix.
Matrix exponential(const Matrix& A);

}  // namespace trochoid::numerics
