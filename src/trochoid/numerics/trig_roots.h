#pragma once

#include <trochoid/numerics/trig_polynomial.h>

#include <cmath>
#include <memory_resource>
#include <vector>

namespace trochoid::numerics {

/// @brief Root of a function that rises or falls from lo to hi, by Newton's steps in a
/// bracket.
/// @param f  ValueAndSlope f(double x)
/// @param x  where to start
template <class Function>
double bracketed_root(const Function& f, double lo, double hi, double x) noexcept {
  const bool rises = f(lo).value < 0;
  for (int i = 0; i < 60; ++i) {
    const auto [value, slope] = f(x);
    ((value < 0) == rises ? lo : hi) = x;
    const double next = x - value / slope;
    const bool good = next > lo && next < hi;
    const double moved = (good ? next : 0.5 * (lo + hi)) - x;
    x += moved;
    if (std::abs(moved) < 4e-15 || !(hi - lo > 1e-13)) {
      break;
    }
  }
  return x;
}

/// @brief Add the angles where a polynomial that is mostly a_0 + b_1 sin(x) passes a level:
/// at most two in a turn, anywhere in it.
void add_roots(const TrigPolynomial& p, double level, std::pmr::vector<double>& roots);

}  // namespace trochoid::numerics
