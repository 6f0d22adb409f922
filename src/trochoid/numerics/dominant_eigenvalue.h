#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace trochoid::numerics {

/// @brief A real square matrix that is known by what it does to a vector.
using LinearMap =
    std::function<void(std::span<const double> in, std::span<double> out)>;

struct DominantEigenvalue {
  std::complex<double> value;  ///< of largest modulus, imaginary part not negative
  std::vector<std::complex<double>> vector;  ///< of unit length, shape (size)
  double residual = 0.0;                     ///< |A x - value x|
  int steps = 0;                             ///< how often the map was applied
};

/// @brief Eigenvalue of largest modulus by Arnoldi's method from a fixed start.
///
/// @eq  D-10 A V_k = V_k H_k + h e_k^T; eigenvalues of H_k
/// @src [arnoldi1951]; [saad2011] ch. 6
/// @param size       of the vectors, at least 1
/// @param tolerance  of the eigenvalue, relative
/// @param expected   steps that a map like this took; 0: not known
/// @note Meant for compact maps, whose eigenvalues fall off fast: no restarts.
DominantEigenvalue dominant_eigenvalue(const LinearMap& map, std::size_t size,
                                       double tolerance, int expected = 0);

}  // namespace trochoid::numerics
