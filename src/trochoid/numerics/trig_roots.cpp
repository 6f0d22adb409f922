#include <trochoid/numerics/trig_roots.h>

#include <trochoid/base/index.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::numerics {

namespace {

using base::index;

using std::numbers::pi;

/// Bound of all but the mean and the sine.
double beyond_the_sine(const TrigPolynomial& p) noexcept {
  double sum = std::abs(p.a[1]);
  for (int k = 2; k <= p.highest; ++k) {
    sum += std::abs(p.a[index(k)]) + std::abs(p.b[index(k)]);
  }
  return sum;
}

ValueAndSlope at(const TrigPolynomial& p, double theta) noexcept {
  return evaluate(p, std::sin(theta), std::cos(theta));
}

struct SineCosine {
  double sine;
  double cosine;
};

/// Of an angle that is ahead by a little, without another call of the library.
SineCosine ahead(const SineCosine& x, double by) noexcept {
  if (std::abs(by) > 0.02) {
    const double s = std::sin(by);
    const double c = std::cos(by);
    return {x.sine * c + x.cosine * s, x.cosine * c - x.sine * s};
  }
  const double u = by * by;
  const double s = by * (1 - u / 6 * (1 - u / 20 * (1 - u / 42)));
  const double less = u / 2 * (1 - u / 12 * (1 - u / 30 * (1 - u / 56)));  // 1 - cos
  return {x.sine + (x.cosine * s - x.sine * less),
          x.cosine - (x.sine * s + x.cosine * less)};
}

/// Root near x by Newton's steps, bent as the first harmonic is.
double near_root(const TrigPolynomial& p, double level, double x,
                 SineCosine at_x) noexcept {
  for (int i = 0; i < 8; ++i) {
    const auto [value, slope] = evaluate(p, at_x.sine, at_x.cosine);
    const double bend = -(p.a[1] * at_x.cosine + p.b[1] * at_x.sine);
    const double straight = (level - value) / slope;
    const double step = straight * (1 - 0.5 * straight * bend / slope);
    x += step;
    if (std::abs(step) < 1e-6) {  // the next one would be a hundredth of its square
      break;
    }
    at_x = ahead(at_x, step);
  }
  return x;
}

/// Where a polynomial that is mostly its first harmonic has its extremum near x.
double extremum(const TrigPolynomial& p, double x) noexcept {
  for (int i = 0; i < 4; ++i) {
    const double cosine = std::cos(x);
    const double sine = std::sin(x);
    double c = 1.0;
    double s = 0.0;
    double slope = 0.0;
    double bend = 0.0;
    for (int k = 1; k <= p.highest; ++k) {
      const double next = c * cosine - s * sine;
      s = s * cosine + c * sine;
      c = next;
      const std::size_t n = index(k);
      slope += k * (p.b[n] * c - p.a[n] * s);
      bend -= k * k * (p.a[n] * c + p.b[n] * s);
    }
    const double step = slope / bend;
    if (!(std::abs(step) < 0.5)) {
      break;
    }
    x -= step;
    if (std::abs(step) < 1e-4) {  // the value there is as good as its square
      break;
    }
  }
  return x;
}

}  // namespace

void add_roots(const TrigPolynomial& p, double level, std::pmr::vector<double>& roots) {
  const double e = p.b[1];
  const double d = p.a[0] - level;
  const double rest = beyond_the_sine(p);
  if (!(std::abs(e) > 0) || std::abs(d) > std::abs(e) + rest) {
    return;
  }
  const double sine = std::clamp(-d / e, -1.0, 1.0);
  const auto f = [&](double theta) {
    const ValueAndSlope found = at(p, theta);
    return ValueAndSlope{found.value - level, found.slope};
  };
  const double guess = std::asin(sine);
  const double cosine = std::sqrt(1 - sine * sine);
  if (rest < 0.2 * std::abs(e) * cosine * cosine) {
    roots.push_back(near_root(p, level, guess, {sine, cosine}));
    roots.push_back(near_root(p, level, pi - guess, {sine, -cosine}));
    return;
  }
  // Near the extrema the two roots run together, or there are none.
  const double top = extremum(p, pi / 2);
  const double bottom = extremum(p, -pi / 2);
  if ((f(top).value < 0) == (f(bottom).value < 0)) {
    return;
  }
  roots.push_back(bracketed_root(f, bottom, top, std::clamp(guess, bottom, top)));
  roots.push_back(bracketed_root(f, top, bottom + 2 * pi,
                                 std::clamp(pi - guess, top, bottom + 2 * pi)));
}

}  // namespace trochoid::numerics
