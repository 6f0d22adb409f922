#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::numerics {

/// @brief All eigenvalues of a complex square matrix, in no order.
/// @param A  column-major, shape (n, n)
std::vector<std::complex<double>> complex_eigenvalues(
    std::span<const std::complex<double>> A, std::size_t n);

/// @brief A size that no eigenvalue exceeds: (|A^4|)^(1/4) in the norm of the largest sum
/// of a column, of a row, or in that of Frobenius, whichever is least. Far cheaper than
/// the eigenvalues.
/// @param A  column-major, shape (n, n)
double eigenvalue_bound(std::span<const std::complex<double>> A, std::size_t n);

}  // namespace trochoid::numerics
