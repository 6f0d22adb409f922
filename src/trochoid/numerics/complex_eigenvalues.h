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

}  // namespace trochoid::numerics
