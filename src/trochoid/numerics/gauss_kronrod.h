#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace trochoid::numerics {

/// Nodes of the 15-point Kronrod rule on [-1, 1] with its embedded 7-point Gauss rule.
struct KronrodRule {
  std::array<double, 15> t;
  std::array<double, 15> kronrod;
  std::array<double, 15> gauss;  ///< 0 at the nodes that only Kronrod uses
};
const KronrodRule& kronrod_rule();

/// @brief Add the integral of a vector function by Gauss and Kronrod with bisection.
///
/// The error of the Kronrod sum is taken as S min(1, (200 |K - G| / S)^1.5), S the
/// integral of |f|: |K - G| itself is the error of the Gauss sum.
/// @src [piessens1983] (QUADPACK)
/// @param f        callable as f(x, weight, sum): adds weight times the values at x
/// @param allowed   error allowed in each component over a bisected part
/// @param smallest parts shorter than this are taken as they are: a jump may hide there
/// @note  six parameters: it calls itself with other ends and everything else the same
template <std::size_t M, class Function>
void add_integral(double from, double to, const Function& f,
                  const std::array<double, M>& allowed, double smallest,
                  std::array<double, M>& sum) {
  const KronrodRule& rule = kronrod_rule();
  const double half = 0.5 * (to - from);
  const double middle = 0.5 * (to + from);
  std::array<double, M> fine{};
  std::array<double, M> coarse{};
  std::array<double, M> size{};
  for (std::size_t i = 0; i < rule.t.size(); ++i) {
    std::array<double, M> value{};
    f(middle + half * rule.t[i], half, value);
    for (std::size_t q = 0; q < M; ++q) {
      fine[q] += rule.kronrod[i] * value[q];
      coarse[q] += rule.gauss[i] * value[q];
      size[q] += rule.kronrod[i] * std::abs(value[q]);
    }
  }
  constexpr double rounding = 1e-13;
  bool good = true;
  bool known = true;  // what is no number does not become one in smaller parts
  for (std::size_t q = 0; q < M; ++q) {
    known = known && std::isfinite(fine[q]);
    const double x = 200 * std::abs(fine[q] - coarse[q]);
    good = good && (x <= std::max(allowed[q], rounding * size[q]) ||
                    (x < size[q] && x * std::sqrt(x / size[q]) <= allowed[q]));
  }
  if (!good && known && to - from > smallest) {
    add_integral(from, middle, f, allowed, smallest, sum);
    add_integral(middle, to, f, allowed, smallest, sum);
    return;
  }
  for (std::size_t q = 0; q < M; ++q) {
    sum[q] += fine[q];
  }
}

}  // namespace trochoid::numerics
