#include <trochoid/numerics/trig_polynomial.h>

namespace trochoid::numerics {

double value(const TrigPolynomial& p, double sine, double cosine) noexcept {
  // Clenshaw's rule.
  const double twice = 2 * cosine;
  double a = 0.0;
  double a_before = 0.0;
  double b = 0.0;
  double b_before = 0.0;
  for (int k = p.highest; k > 0; --k) {
    const auto i = static_cast<std::size_t>(k);
    const double next_a = p.a[i] + twice * a - a_before;
    const double next_b = p.b[i] + twice * b - b_before;
    a_before = a;
    b_before = b;
    a = next_a;
    b = next_b;
  }
  return p.a[0] + cosine * a - a_before + sine * b;
}

ValueAndSlope evaluate(const TrigPolynomial& p, double sine, double cosine) noexcept {
  // cos(k x) and sin(k x) by turning on: both are needed.
  double c = 1.0;
  double s = 0.0;
  ValueAndSlope out{p.a[0], 0.0};
  for (int k = 1; k <= p.highest; ++k) {
    const double next = c * cosine - s * sine;
    s = s * cosine + c * sine;
    c = next;
    const auto i = static_cast<std::size_t>(k);
    out.value += p.a[i] * c + p.b[i] * s;
    out.slope += k * (p.b[i] * c - p.a[i] * s);
  }
  return out;
}

TrigPolynomial times_first_harmonic(const TrigPolynomial& p, double A, double B,
                                    double C) noexcept {
  TrigPolynomial out;
  out.highest = p.highest + 1;
  const auto top = static_cast<std::size_t>(out.highest);
  for (std::size_t k = 0; k <= top; ++k) {
    const bool inside = k < top;
    out.a[k] = inside ? C * p.a[k] : 0.0;
    out.b[k] = inside ? C * p.b[k] : 0.0;
  }
  // cos(x) cos(k x) = (cos((k + 1) x) + cos((k - 1) x))/2, and so on.
  const double half_A = 0.5 * A;
  const double half_B = 0.5 * B;
  out.a[1] += A * p.a[0];
  out.b[1] += B * p.a[0];
  for (std::size_t k = 1; k < top; ++k) {
    out.a[k + 1] += half_A * p.a[k] - half_B * p.b[k];
    out.b[k + 1] += half_A * p.b[k] + half_B * p.a[k];
    out.a[k - 1] += half_A * p.a[k] + half_B * p.b[k];
    out.b[k - 1] += half_A * p.b[k] - half_B * p.a[k];
  }
  out.b[0] = 0.0;
  return out;
}

TrigPolynomial shifted(const TrigPolynomial& p, double sine, double cosine) noexcept {
  TrigPolynomial out;
  out.highest = p.highest;
  out.a[0] = p.a[0];
  out.b[0] = 0.0;
  double c = 1.0;
  double s = 0.0;
  for (int k = 1; k <= p.highest; ++k) {
    const double next = c * cosine - s * sine;
    s = s * cosine + c * sine;
    c = next;
    const auto i = static_cast<std::size_t>(k);
    out.a[i] = p.a[i] * c + p.b[i] * s;
    out.b[i] = p.b[i] * c - p.a[i] * s;
  }
  return out;
}

TrigPolynomial antiderivative(const TrigPolynomial& p) noexcept {
  TrigPolynomial out;
  out.highest = p.highest;
  out.a[0] = 0.0;
  out.b[0] = 0.0;
  for (int k = 1; k <= p.highest; ++k) {
    const auto i = static_cast<std::size_t>(k);
    out.a[i] = -p.b[i] / k;
    out.b[i] = p.a[i] / k;
  }
  return out;
}

}  // namespace trochoid::numerics
