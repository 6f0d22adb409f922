#include <trochoid/dynamics/point_response.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::dynamics {

namespace {

/// The cubic through the four lines around omega, or through all if there are fewer.
std::complex<double> between_lines(const MeasuredReceptance& part, double omega) {
  const std::size_t n = part.omega.size();
  const std::size_t count = std::min<std::size_t>(4, n);
  const auto above = std::upper_bound(part.omega.begin(), part.omega.end(), omega);
  const auto after = static_cast<std::size_t>(above - part.omega.begin());
  const std::size_t first =
      std::min(after > count / 2 ? after - count / 2 : 0, n - count);
  std::complex<double> sum;
  for (std::size_t i = first; i < first + count; ++i) {
    double weight = 1.0;
    for (std::size_t j = first; j < first + count; ++j) {
      if (j != i) {
        weight *= (omega - part.omega[j]) / (part.omega[i] - part.omega[j]);
      }
    }
    sum += weight * part.H[i];
  }
  return sum;
}

std::complex<double> at(const MeasuredReceptance& part, double omega) {
  if (omega < part.omega.front()) {
    return part.H.front().real();
  }
  if (omega > part.omega.back()) {
    return 0.0;
  }
  return between_lines(part, omega);
}

}  // namespace

ComplexMatrix2 receptance(const PointResponse& point, double omega) noexcept {
  ComplexMatrix2 G{};
  for (const MeasuredReceptance& part : point.parts) {
    G[2 * part.motion + part.force] += at(part, std::abs(omega));
  }
  if (omega < 0) {
    for (std::complex<double>& g : G) {
      g = std::conj(g);
    }
  }
  return G;  // D-20
}

Band band_of(const PointResponse& point) noexcept {
  Band band{0.0, std::numeric_limits<double>::infinity()};
  for (const MeasuredReceptance& part : point.parts) {
    band.from = std::max(band.from, part.omega.front());
    band.to = std::min(band.to, part.omega.back());
  }
  return band;
}

double narrowest_peak(const PointResponse& point) noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (const MeasuredReceptance& part : point.parts) {
    const auto peak = std::max_element(
        part.H.begin(), part.H.end(),
        [](const auto& a, const auto& b) { return std::norm(a) < std::norm(b); });
    const double half_power = 0.5 * std::norm(*peak);
    auto from = static_cast<std::size_t>(peak - part.H.begin());
    std::size_t to = from;
    while (from > 0 && std::norm(part.H[from - 1]) > half_power) --from;
    while (to + 1 < part.H.size() && std::norm(part.H[to + 1]) > half_power) ++to;
    least = std::min(least, part.omega[to] - part.omega[from]);
  }
  return least;
}

double line_distance(const PointResponse& point) noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (const MeasuredReceptance& part : point.parts) {
    const auto lines = static_cast<double>(part.omega.size() - 1);
    least = std::min(least, (part.omega.back() - part.omega.front()) / lines);
  }
  return least;
}

}  // namespace trochoid::dynamics
