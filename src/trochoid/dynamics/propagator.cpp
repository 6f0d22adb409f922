#include <trochoid/dynamics/propagator.h>

#include <Eigen/Core>
#include <unsupported/Eigen/MatrixFunctions>

#include <cmath>

namespace trochoid::dynamics {

namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Vector = Eigen::VectorXd;

std::vector<double> values_of(const Matrix& m) {
  return {m.data(), m.data() + m.size()};
}

/// Units of the states in which rows and columns are of one size: metres and metres per
/// second are not, and an exponential of a fast mode would lose all its digits.
Vector balanced_units(const Matrix& A) {
  Vector units = Vector::Ones(A.rows());
  for (int round = 0; round < 30; ++round) {
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      double row = 0.0;
      double column = 0.0;
      for (Eigen::Index k = 0; k < A.rows(); ++k) {
        if (k != i) {
          row += std::abs(A(i, k)) * units(k) / units(i);
          column += std::abs(A(k, i)) * units(i) / units(k);
        }
      }
      if (row > 0 && column > 0) {
        units(i) *= std::exp2(std::round(0.5 * std::log2(row / column)));
      }
    }
  }
  return units;
}

}  // namespace

Propagator propagator(std::span<const double> A, std::span<const double> B,
                      std::size_t states, double dt) {
  const auto n = static_cast<Eigen::Index>(states);
  const auto m = static_cast<Eigen::Index>(B.size() / states);
  const Eigen::Map<const Matrix> own(A.data(), n, n);
  const Vector units = balanced_units(own);
  const auto per_unit = units.cwiseInverse().asDiagonal();
  const Matrix own_balanced = per_unit * own * units.asDiagonal();
  Matrix driven = per_unit * Eigen::Map<const Matrix>(B.data(), n, m);
  Vector inputs = Vector::Ones(m);  // units that make B as large as A
  for (Eigen::Index i = 0; i < m; ++i) {
    const double size = driven.col(i).cwiseAbs().maxCoeff();
    const double wanted = own_balanced.cwiseAbs().maxCoeff();
    if (size > 0 && wanted > 0) {
      inputs(i) = wanted / size;
    }
  }
  // z' = A z + B u, u' = v/dt, v' = 0 over one unit of t/dt
  Matrix whole = Matrix::Zero(n + 2 * m, n + 2 * m);
  whole.topLeftCorner(n, n) = dt * own_balanced;
  whole.block(0, n, n, m) = dt * driven * inputs.asDiagonal();
  whole.block(n, n + m, m, m).setIdentity();
  const Matrix step = whole.exp();
  const auto per_input = inputs.cwiseInverse().asDiagonal();
  const Matrix ramp = units.asDiagonal() * step.block(0, n + m, n, m) * per_input;
  const Matrix constant = units.asDiagonal() * step.block(0, n, n, m) * per_input;
  const Matrix Phi = units.asDiagonal() * step.topLeftCorner(n, n) * per_unit;
  return {states, B.size() / states, values_of(Phi), values_of(constant - ramp),
          values_of(ramp)};
}

}  // namespace trochoid::dynamics
