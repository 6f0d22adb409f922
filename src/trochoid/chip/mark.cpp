#include <trochoid/chip/mark.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trochoid::chip {

namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();

/// sin(x) to rounding for |x| <= 0.2, where libm's range reduction would cost the most.
double small_sine(double x) noexcept {
  const double u = x * x;
  return x * (1 - u / 6 * (1 - u / 20 * (1 - u / 42 * (1 - u / 72 * (1 - u / 110)))));
}

/// @param half_sine  sin(delta / 2)
double length_on_ray(double R_k, double turned, double feed, double sin_theta,
                     double half_sine) noexcept {
  return R_k - 2 * R_k * half_sine * half_sine - feed * turned * sin_theta;  // C-6
}

/// Root of sin(x) + A (theta_p + x) in [lo, hi], where the function rises.
double bracketed_root(double A, double theta_p, double lo, double hi) noexcept {
  // Where the root is nearly double, no better x exists than one with g at rounding.
  const double rounding = 2e-16 * (1 + std::abs(A) * theta_p);
  const double x0 = -A * theta_p / (1 + A);
  double x = -(A * theta_p - x0 * x0 * x0 / 6) / (1 + A);
  if (!(x > lo && x < hi)) {
    x = 0.5 * (lo + hi);
  }
  for (int i = 0; i < 64; ++i) {
    const double g = std::sin(x) + A * (theta_p + x);
    (g < 0 ? lo : hi) = x;
    if (std::abs(g) <= rounding) {
      break;
    }
    const double slope = std::cos(x) + A;
    const double next = x - g / slope;
    if (!(next > lo && next < hi)) {
      x = 0.5 * (lo + hi);
      continue;
    }
    const double step = next - x;
    x = next;
    if (step * step <= 1e-17 * slope) {  // what is left is its square
      break;
    }
  }
  return x;
}

}  // namespace

double surface_left(double R_k, double theta_p, double feed, double sin_theta,
                    double cos_theta) noexcept {
  const double A = feed * cos_theta / R_k;
  if (std::abs(A) < 0.02) {
    // Third-order start, good to x^5/12; every Newton step gains s^4/8 on it.
    const double x0 = -A * theta_p / (1 + A);
    double x = -(A * theta_p - x0 * x0 * x0 / 6) / (1 + A);
    const int steps = std::abs(x) < 0.02 ? 1 : 2;
    for (int i = 0; i < steps; ++i) {
      const double s = small_sine(x);
      x -= (s + A * (theta_p + x)) / (1 - 0.5 * s * s + A);
    }
    return length_on_ray(R_k, theta_p + x, feed, sin_theta, small_sine(0.5 * x));
  }
  constexpr double right = std::numbers::pi / 2;
  if (A >= 0) {
    if (A * (theta_p - right) >= 1) {
      return nothing;
    }
    const double delta = bracketed_root(A, theta_p, -right, 0.0);
    return length_on_ray(R_k, theta_p + delta, feed, sin_theta, std::sin(0.5 * delta));
  }
  if (A <= -1) {
    return nothing;
  }
  const double top = std::acos(-A);
  if (std::sin(top) < -A * (theta_p + top)) {
    return nothing;
  }
  const double delta = bracketed_root(A, theta_p, 0.0, top);
  return length_on_ray(R_k, theta_p + delta, feed, sin_theta, std::sin(0.5 * delta));
}

}  // namespace trochoid::chip
