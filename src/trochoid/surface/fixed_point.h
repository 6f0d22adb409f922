#pragma once

#include <trochoid/numerics/columns.h>
#include <trochoid/numerics/least_squares.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

/// Deflections that the forces they lead to bring about.
namespace trochoid::surface::fixed_point {

inline double largest_of(std::span<const double> v) {
  double largest = 0.0;
  for (const double x : v) {
    largest = std::max(largest, std::abs(x));
  }
  return largest;
}

/// What a solution must reach, and beyond what there is none.
struct Limits {
  double allowed = 0.0;  ///< of the residual [m]
  double largest = 0.0;  ///< deflection [m]
};

/// Steps on the way may overshoot the largest deflection by this.
inline constexpr double lost = 50;

/// @brief u with image(u) = u, by Broyden's method
/// from the Jacobian -1 of the residual.
/// @src [broyden1965], as in [kelley1995] 7.3: only the steps are kept
template <class Image>
bool solve_fixed_point(const Image& image, std::vector<double>& u,
                       const Limits& limits) {
  constexpr int most_steps = 60;
  std::vector<double> r(u.size());
  std::vector<std::vector<double>> steps;
  for (int k = 0; k < most_steps; ++k) {
    image(u, r);
    for (std::size_t i = 0; i < u.size(); ++i) {
      r[i] -= u[i];
    }
    if (largest_of(r) <= limits.allowed) {
      return largest_of(u) <= limits.largest;
    }
    if (largest_of(u) > lost * limits.largest) {
      return false;
    }
    std::vector<double> z = r;
    for (std::size_t n = 0; n < steps.size(); ++n) {
      const double part =
          numerics::dot(steps[n], z) / numerics::dot(steps[n], steps[n]);
      const bool last = n + 1 == steps.size();
      const double factor = last ? 1 / std::max(1 - part, 0.1) : 1.0;
      for (std::size_t i = 0; i < z.size(); ++i) {
        z[i] = last ? factor * z[i] : z[i] + part * steps[n + 1][i];
      }
    }
    for (std::size_t i = 0; i < u.size(); ++i) {
      u[i] += z[i];
    }
    steps.push_back(std::move(z));
  }
  return false;
}

/// u with image(u) = u, by Newton's method with differences and shortened steps: slow,
/// and sure where Broyden's method loses its way.
template <class Image>
bool solve_by_newton(const Image& image, std::vector<double>& u, const Limits& limits) {
  constexpr int most_steps = 40;
  const std::size_t n = u.size();
  std::vector<double> r(n);
  std::vector<double> moved(n);
  const auto residual = [&](const std::vector<double>& at, std::vector<double>& out) {
    image(at, out);
    for (std::size_t i = 0; i < n; ++i) {
      out[i] -= at[i];
    }
  };
  residual(u, r);
  for (int k = 0; k < most_steps && largest_of(r) > limits.allowed; ++k) {
    if (largest_of(u) > limits.largest) {
      return false;
    }
    const double h = std::max(10 * limits.allowed, 1e-4 * largest_of(u));
    std::vector<double> J(n * n);
    for (std::size_t c = 0; c < n; ++c) {
      std::vector<double> there = u;
      there[c] += h;
      residual(there, moved);
      for (std::size_t i = 0; i < n; ++i) {
        J[i * n + c] = (r[i] - moved[i]) / h;
      }
    }
    const std::vector<double> step =
        numerics::least_squares(J, static_cast<int>(n), r, 1e-13).x;
    bool better = false;
    for (int halvings = 0; halvings <= 13 && !better; ++halvings) {
      const double share = std::ldexp(1.0, -halvings);
      std::vector<double> there = u;
      for (std::size_t i = 0; i < n; ++i) {
        there[i] += share * step[i];
      }
      residual(there, moved);
      better = numerics::dot(moved, moved) < (1 - 0.2 * share) * numerics::dot(r, r);
      if (better) {
        u = there;
        r = moved;
      }
    }
    if (!better) {
      return false;
    }
  }
  return largest_of(r) <= limits.allowed && largest_of(u) <= limits.largest;
}

}  // namespace trochoid::surface::fixed_point
