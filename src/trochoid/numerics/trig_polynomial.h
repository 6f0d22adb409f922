#pragma once

#include <array>

namespace trochoid::numerics {

/// @brief a_0 + sum over k of a_k cos(k x) + b_k sin(k x), k from 1 to `highest`.
///
/// Entries above `highest` mean nothing.
struct TrigPolynomial {
  static constexpr int most = 20;  ///< harmonics at most
  int highest = 0;
  std::array<double, most + 1> a;
  std::array<double, most + 1> b;  ///< b[0] is 0
};

/// A value and its derivative.
struct ValueAndSlope {
  double value = 0.0;
  double slope = 0.0;
};

/// @brief From the sine and cosine of x.
double value(const TrigPolynomial& p, double sine, double cosine) noexcept;
ValueAndSlope evaluate(const TrigPolynomial& p, double sine, double cosine) noexcept;

/// @brief The product with A cos(x) + B sin(x) + C, one harmonic higher.
TrigPolynomial times_first_harmonic(const TrigPolynomial& p, double A, double B,
                                    double C) noexcept;

/// @brief The same function of x + shift.
/// @param sine, cosine  of the shift
TrigPolynomial shifted(const TrigPolynomial& p, double sine, double cosine) noexcept;

/// @brief The antiderivative without its linear term: that is a_0 x.
TrigPolynomial antiderivative(const TrigPolynomial& p) noexcept;

}  // namespace trochoid::numerics
