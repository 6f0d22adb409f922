#include <trochoid/signal/band.h>

#include <Eigen/QR>
#include <cmath>
#include <stdexcept>

namespace trochoid::signal {

Band::Band(std::span<const double> angle, int harmonics) : samples_(angle.size()) {
  if (angle.empty() || harmonics < 0) {
    throw std::invalid_argument("Band: angles and harmonics >= 0 are needed");
  }
  const auto n = static_cast<Eigen::Index>(angle.size());
  Eigen::MatrixXd A(n, 2 * Eigen::Index{harmonics} + 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    A(i, 0) = 1.0;
    for (int m = 1; m <= harmonics; ++m) {
      const double phase = m * angle[static_cast<std::size_t>(i)];
      A(i, 2 * m - 1) = std::cos(phase);
      A(i, 2 * m) = std::sin(phase);
    }
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  qr.setThreshold(1e-8);
  size_ = static_cast<int>(qr.rank());
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(n, qr.rank());
  basis_.assign(Q.data(), Q.data() + Q.size());
}

std::vector<double> Band::coordinates(std::span<const double> samples) const {
  if (samples.size() != samples_) {
    throw std::invalid_argument("Band: one sample an angle is needed");
  }
  const auto n = static_cast<Eigen::Index>(samples_);
  const Eigen::Map<const Eigen::MatrixXd> Q(basis_.data(), n, size_);
  const Eigen::Map<const Eigen::VectorXd> x(samples.data(), n);
  const Eigen::VectorXd c = Q.transpose() * x;
  return {c.data(), c.data() + c.size()};
}

std::vector<double> Band::project(std::span<const double> samples) const {
  const auto c = coordinates(samples);
  const auto n = static_cast<Eigen::Index>(samples_);
  const Eigen::Map<const Eigen::MatrixXd> Q(basis_.data(), n, size_);
  const Eigen::Map<const Eigen::VectorXd> coordinates(c.data(), size_);
  const Eigen::VectorXd part = Q * coordinates;
  return {part.data(), part.data() + part.size()};
}

}  // namespace trochoid::signal
