#include <trochoid/numerics/complex_eigenvalues.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trochoid::numerics {

namespace {

using ComplexDense = Eigen::MatrixXcd;

Eigen::Map<const ComplexDense> square(std::span<const std::complex<double>> A,
                                      std::size_t n) {
  if (n == 0 || A.size() != n * n) {
    throw std::invalid_argument("complex_eigenvalues: the matrix is not (n, n), n > 0");
  }
  const auto size = static_cast<Eigen::Index>(n);
  return {A.data(), size, size};
}

}  // namespace

std::vector<std::complex<double>> complex_eigenvalues(
    std::span<const std::complex<double>> A, std::size_t n) {
  const Eigen::ComplexEigenSolver<ComplexDense> solver(square(A, n), false);
  const auto& values = solver.eigenvalues();
  return {values.data(), values.data() + values.size()};
}

double eigenvalue_bound(std::span<const std::complex<double>> A, std::size_t n) {
  const auto map = square(A, n);
  const ComplexDense second = map * map;
  const ComplexDense fourth = second * second;
  const double columns = fourth.cwiseAbs().colwise().sum().maxCoeff();
  const double rows = fourth.cwiseAbs().rowwise().sum().maxCoeff();
  return std::sqrt(std::sqrt(std::min({columns, rows, fourth.norm()})));
}

}  // namespace trochoid::numerics
