#include <trochoid/numerics/dense.h>
#include <trochoid/numerics/least_squares.h>
#include <trochoid/signal/band.h>

#include <cmath>
#include <stdexcept>

namespace trochoid::signal {

Band::Band(std::span<const double> angle, int harmonics) : samples_(angle.size()) {
  if (angle.empty() || harmonics < 0) {
    throw std::invalid_argument("Band: angles and harmonics >= 0 are needed");
  }
  std::vector<double> A;
  A.reserve(angle.size() * (2 * static_cast<std::size_t>(harmonics) + 1));
  for (const double phi : angle) {
    A.push_back(1.0);
    for (int m = 1; m <= harmonics; ++m) {
      A.push_back(std::cos(m * phi));
      A.push_back(std::sin(m * phi));
    }
  }
  basis_ = numerics::orthonormal(A, 2 * harmonics + 1, 1e-8);
  size_ = static_cast<int>(basis_.size() / samples_);
}

std::vector<double> Band::coordinates(std::span<const double> samples) const {
  if (samples.size() != samples_) {
    throw std::invalid_argument("Band: one sample an angle is needed");
  }
  // Row by row, which is the transposed basis column by column.
  std::vector<double> c(static_cast<std::size_t>(size_));
  numerics::add_product(1.0, basis_, samples, c);
  return c;
}

std::vector<double> Band::project(std::span<const double> samples) const {
  const auto c = coordinates(samples);
  std::vector<double> part(samples_);
  numerics::transposed_product(basis_, c, part);
  return part;
}

}  // namespace trochoid::signal
