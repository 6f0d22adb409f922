#include <trochoid/chip/mark.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trochoid::chip {

namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();

double length_on_ray(double R_k, double theta_p, double feed, double sin_theta,
                     double delta) noexcept {
  const double half = std::sin(delta / 2);
  return R_k - 2 * R_k * half * half - feed * (theta_p + delta) * sin_theta;  // C-6
}

/// Root of sin(x) + A (theta_p + x) in [lo, hi], where the function rises.
double bracketed_root(double A, double theta_p, double lo, double hi) noexcept {
  // Where the root is nearly double, no better x exists than one with g at rounding.
  const double rounding = 2e-16 * (1 + std::abs(A) * theta_p);
  double x = 0.5 * (lo + hi);
  for (int i = 0; i < 64; ++i) {
    const double g = std::sin(x) + A * (theta_p + x);
    (g < 0 ? lo : hi) = x;
    if (std::abs(g) <= rounding) {
      break;
    }
    const double next = x - g / (std::cos(x) + A);
    x = next > lo && next < hi ? next : 0.5 * (lo + hi);
  }
  return x;
}

}  // namespace

double surface_left(double R_k, double theta_p, double feed, double sin_theta,
                    double cos_theta) noexcept {
  const double A = feed * cos_theta / R_k;
  if (std::abs(A) < 0.02) {
    // Third-order start, good to 1e-6 of delta; two Newton steps reach rounding.
    const double x0 = -A * theta_p / (1 + A);
    double x = -(A * theta_p - x0 * x0 * x0 / 6) / (1 + A);
    for (int i = 0; i < 2; ++i) {
      const double s = std::sin(x);
      x -= (s + A * (theta_p + x)) / (std::sqrt(1 - s * s) + A);
    }
    return length_on_ray(R_k, theta_p, feed, sin_theta, x);
  }
  constexpr double right = std::numbers::pi / 2;
  if (A >= 0) {
    if (A * (theta_p - right) >= 1) {
      return nothing;
    }
    const double delta = bracketed_root(A, theta_p, -right, 0.0);
    return length_on_ray(R_k, theta_p, feed, sin_theta, delta);
  }
  if (A <= -1) {
    return nothing;
  }
  const double top = std::acos(-A);
  if (std::sin(top) < -A * (theta_p + top)) {
    return nothing;
  }
  const double delta = bracketed_root(A, theta_p, 0.0, top);
  return length_on_ray(R_k, theta_p, feed, sin_theta, delta);
}

}  // namespace trochoid::chip
