#pragma once

#include <span>
#include <vector>

namespace trochoid::numerics {

/// @brief Fourier coefficients of periodic functions from equal steps over a period.
///
/// f(x) = a_0 + sum over m of (a_m cos(m x) + b_m sin(m x)), x = 2 pi k/n at step k.
/// @param values   row-major, shape (n, width); n a power of two
/// @param highest  largest m, below n/2
/// @return a_0, a_1, b_1, a_2, ...: row-major, shape (2 highest + 1, width)
/// @throws std::invalid_argument when n or highest is something else
std::vector<double> fourier_coefficients(std::span<const double> values,
                                         std::size_t width, int highest);

}  // namespace trochoid::numerics
