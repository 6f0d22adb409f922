#include <trochoid/numerics/lagrange.h>

#include <cmath>
#include <numbers>

namespace trochoid::numerics {

LagrangeBasis::LagrangeBasis(double from, double to, int count) {
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  for (int i = count; i-- > 0;) {
    const double angle = (i + 0.5) * std::numbers::pi / count;
    points_.push_back(middle + half * std::cos(angle));
    barycentric_.push_back((i % 2 == 0 ? 1.0 : -1.0) * std::sin(angle));
  }
}

void LagrangeBasis::weights(double x, std::span<double> out) const noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (x == points_[i]) {
      for (std::size_t k = 0; k < points_.size(); ++k) {
        out[k] = k == i ? 1.0 : 0.0;
      }
      return;
    }
    out[i] = barycentric_[i] / (x - points_[i]);
    sum += out[i];
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    out[i] /= sum;
  }
}

double LagrangeBasis::value(std::span<const double> values, double x) const noexcept {
  double sum = 0.0;
  double weighted = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (x == points_[i]) {
      return values[i];
    }
    const double w = barycentric_[i] / (x - points_[i]);
    sum += w;
    weighted += w * values[i];
  }
  return weighted / sum;
}

}  // namespace trochoid::numerics
