#include <trochoid/numerics/lagrange.h>

#include <cmath>
#include <numbers>

namespace trochoid::numerics {

LagrangeBasis::LagrangeBasis(double from, double to, int count)
    : middle_(0.5 * (from + to)), per_half_(to == from ? 0.0 : 2 / (to - from)) {
  std::vector<double> angles;
  for (int i = count; i-- > 0;) {
    angles.push_back((i + 0.5) * std::numbers::pi / count);
    points_.push_back(middle_ + 0.5 * (to - from) * std::cos(angles.back()));
    barycentric_.push_back((i % 2 == 0 ? 1.0 : -1.0) * std::sin(angles.back()));
  }
  for (int k = 0; k < count; ++k) {
    for (const double angle : angles) {
      to_series_.push_back((k == 0 ? 1.0 : 2.0) / count * std::cos(k * angle));
    }
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

void LagrangeBasis::series(std::span<const double> values,
                           std::span<double> out) const noexcept {
  const std::size_t n = points_.size();
  for (std::size_t k = 0; k < n; ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      sum += to_series_[k * n + i] * values[i];
    }
    out[k] = sum;
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
