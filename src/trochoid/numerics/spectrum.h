#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::numerics {

/// @brief Discrete Fourier transform of real values, X_k = sum x_j e^{-2 pi i j k/n}.
/// @param values  shape (n), n even; fast where n has small factors only
/// @return X_0 to X_{n/2}
/// @throws std::invalid_argument when n is odd or 0
std::vector<std::complex<double>> real_spectrum(std::span<const double> values);

/// @brief The largest even number up to n without a prime factor above 5; n at least 2.
std::size_t fast_length(std::size_t n);

}  // namespace trochoid::numerics
