#include <trochoid/numerics/complex_eigenvalues.h>

#include <Eigen/Eigenvalues>
#include <stdexcept>

namespace trochoid::numerics {

std::vector<std::complex<double>> complex_eigenvalues(
    std::span<const std::complex<double>> A, std::size_t n) {
  if (n == 0 || A.size() != n * n) {
    throw std::invalid_argument("complex_eigenvalues: the matrix is not (n, n), n > 0");
  }
  const auto size = static_cast<Eigen::Index>(n);
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(
      Eigen::Map<const Eigen::MatrixXcd>(A.data(), size, size), false);
  const auto& values = solver.eigenvalues();
  return {values.data(), values.data() + values.size()};
}

}  // namespace trochoid::numerics
