#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace trochoid::dynamics {

/// @brief u^p for normal u > 0 and |p log2(u)| < 1000, to a few 1e-15 of the result.
///
/// Without branches, so that a compiler takes several u at once: u = 2^e s with s about
/// 1, log2(s) from the series of the area hyperbolic tangent, 2^y from that of the
/// exponential about the nearest whole number.
inline double power_of(double u, double p) noexcept {
  constexpr std::uint64_t fraction = 0x000fffffffffffffULL;
  constexpr std::uint64_t half_root = 0x0009'5f61'9980'c433ULL;  // of 1.5858...
  constexpr double two_52 = 4503599627370496.0;
  const auto bits = std::bit_cast<std::uint64_t>(u);
  // s in [0.79, 1.59): the exponent counts from there
  const std::uint64_t shifted = bits + (0x0010'0000'0000'0000ULL - half_root);
  const double e =
      std::bit_cast<double>((shifted >> 52U) | std::bit_cast<std::uint64_t>(two_52)) -
      (two_52 + 1023.0);
  const double s = std::bit_cast<double>(
      ((shifted & fraction) + half_root + 0x3fe0'0000'0000'0000ULL));
  const double t = (s - 1) / (s + 1);
  const double t_2 = t * t;
  const double t_4 = t_2 * t_2;
  const double t_8 = t_4 * t_4;
  const double series =
      ((1 + t_2 * (1.0 / 3)) + t_4 * (1.0 / 5 + t_2 * (1.0 / 7))) +
      t_8 * ((1.0 / 9 + t_2 * (1.0 / 11)) + t_4 * (1.0 / 13 + t_2 * (1.0 / 15)) +
             t_8 * (1.0 / 17 + t_2 * (1.0 / 19)));
  constexpr double two_over_ln_2 = 2.8853900817779268;
  const double y = p * (e + two_over_ln_2 * t * series);
  constexpr double to_whole = 6755399441055744.0;  // 1.5 2^52
  const double rounded = y + to_whole;
  const double n = rounded - to_whole;
  const double x = (y - n) * 0.6931471805599453;
  const double x_2 = x * x;
  const double x_4 = x_2 * x_2;
  const double x_8 = x_4 * x_4;
  const double exponential =
      ((1 + x) + x_2 * (1.0 / 2 + x * (1.0 / 6))) +
      x_4 * ((1.0 / 24 + x * (1.0 / 120)) + x_2 * (1.0 / 720 + x * (1.0 / 5040))) +
      x_8 * ((1.0 / 40320 + x * (1.0 / 362880)) +
             x_2 * (1.0 / 3628800 + x * (1.0 / 39916800)) + x_4 * (1.0 / 479001600));
  return exponential *
         std::bit_cast<double>((std::bit_cast<std::uint64_t>(rounded) + 1023U) << 52U);
}

}  // namespace trochoid::dynamics
