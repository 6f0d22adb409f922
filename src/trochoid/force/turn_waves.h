#pragma once

#include <trochoid/force/turn_polynomial.h>
#include <trochoid/numerics/trig_polynomial.h>

#include <array>
#include <span>

/// Three trigonometric polynomials at once, as a row: mean, then the factors of cos(x),
/// sin(x), cos(2 x), sin(2 x) ... up to a harmonic that all rows of a turn share.
namespace trochoid::force {

/// a + factor b. Read before anything is written, so that it becomes whole vectors.
constexpr Triple plus(const Triple& a, const Triple& b, double factor) noexcept {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2],
          a[3] + factor * b[3]};
}
/// factor a.
constexpr Triple scaled(const Triple& a, double factor) noexcept {
  return {factor * a[0], factor * a[1], factor * a[2], factor * a[3]};
}
/// factor_a a + factor_b b.
constexpr Triple mixed(const Triple& a, double factor_a, const Triple& b,
                       double factor_b) noexcept {
  return {factor_a * a[0] + factor_b * b[0], factor_a * a[1] + factor_b * b[1],
          factor_a * a[2] + factor_b * b[2], factor_a * a[3] + factor_b * b[3]};
}

using WaveRow = std::span<Triple>;
using ConstWaveRow = std::span<const Triple>;

constexpr std::size_t waves_of(int highest) noexcept {
  return 1 + 2 * static_cast<std::size_t>(highest);
}

/// Cosine and sine of the multiples of an angle.
struct Turned {
  Turned(double angle, int highest) noexcept;

  std::array<double, numerics::TrigPolynomial::most + 2> cosine;
  std::array<double, numerics::TrigPolynomial::most + 2> sine;
};

/// @brief g of theta (F-10): the weights applied to a chip.
/// @param h  chip, or null: where only the edge counts
void integrand(const numerics::TrigPolynomial* h, const TurnWeights& weights,
               double edge_factor, WaveRow g) noexcept;

/// @brief factor times the antiderivative; its linear term is the mean of the row.
void integrate(ConstWaveRow g, double factor, WaveRow G) noexcept;

/// @brief The same function of an angle that is ahead of x by a given one.
void shift_back(ConstWaveRow p, const Turned& by, double factor, WaveRow out) noexcept;

/// sum += factor p, row by row.
void add(ConstWaveRow p, double factor, WaveRow sum) noexcept;

/// Value at an angle, without the mean.
Triple waves_at(ConstWaveRow p, const Turned& x) noexcept;

/// Slope at an angle.
Triple wave_slope_at(ConstWaveRow p, const Turned& x) noexcept;

}  // namespace trochoid::force
