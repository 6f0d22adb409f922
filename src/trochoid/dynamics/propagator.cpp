#include <trochoid/dynamics/propagator.h>

#include <Eigen/Core>
#include <unsupported/Eigen/MatrixFunctions>

namespace trochoid::dynamics {

namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::vector<double> values_of(const Matrix& m) {
  return {m.data(), m.data() + m.size()};
}

}  // namespace

Propagator propagator(std::span<const double> A, std::span<const double> B,
                      std::size_t states, double dt) {
  const auto n = static_cast<Eigen::Index>(states);
  const auto m = static_cast<Eigen::Index>(B.size() / states);
  // z' = A z + B u, u' = v/dt, v' = 0 over one unit of t/dt
  Matrix whole = Matrix::Zero(n + 2 * m, n + 2 * m);
  whole.topLeftCorner(n, n) = dt * Eigen::Map<const Matrix>(A.data(), n, n);
  whole.block(0, n, n, m) = dt * Eigen::Map<const Matrix>(B.data(), n, m);
  whole.block(n, n + m, m, m).setIdentity();
  const Matrix step = whole.exp();
  const Matrix ramp = step.block(0, n + m, n, m);
  const Matrix constant = step.block(0, n, n, m);
  return {states, B.size() / states, values_of(step.topLeftCorner(n, n)),
          values_of(constant - ramp), values_of(ramp)};
}

}  // namespace trochoid::dynamics
