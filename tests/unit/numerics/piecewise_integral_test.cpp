#include <gtest/gtest.h>
#include <trochoid/numerics/piecewise_integral.h>

#include <cmath>
#include <vector>

namespace trochoid::numerics::piecewise_integral_test {

using Integral = PiecewiseIntegral<3>;

/// cos, sin and 1 on two intervals of a period from -1 to 6.
Integral two_intervals() {
  Integral out(-1.0, 7.0);
  const auto f = [](double x) {
    return Integral::Values{std::cos(x), std::sin(x), 1.0};
  };
  const Integral::Values allowed{1e-10, 1e-10, 1e-10};
  out.append(-0.5, 1.7, f, 0.8, allowed);
  out.append(2.0, 4.5, f, 1.6, allowed);
  out.finish();
  return out;
}

TEST(PiecewiseIntegral, AtManyPlacesIsThatAtEach) {
  const Integral integral = two_intervals();
  std::vector<double> x;
  for (double at = -3.0; at < 9.0; at += 0.037) x.push_back(at);
  for (const double length : {0.0, 0.3, 2.5, 8.0}) {
    std::vector<double> out(2 * x.size(), 1.0);
    integral.add_between(x, -0.2, length - 0.2, out);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double from = std::clamp(x[i] - 0.2, -1.0, 6.0);
      const double to = std::clamp(x[i] - 0.2 + length, -1.0, 6.0);
      std::array<double, 2> one{};
      if (to > from) integral.add_between(from, to, one);
      EXPECT_NEAR(out[i], 1 + one[0], 1e-14) << x[i];
      EXPECT_NEAR(out[x.size() + i], 1 + one[1], 1e-14) << x[i];
    }
  }
}

TEST(PiecewiseIntegral, TakesPartsOfAnother) {
  const Integral whole = two_intervals();
  Integral parts(-1.0, 7.0);
  parts.append(whole, 0.3, 1.2);
  parts.append(whole, 1.5, 2.6);
  parts.append(whole, 4.0, 5.5);
  parts.finish();
  const auto sine = [](double from, double to) {
    return std::sin(to) - std::sin(from);
  };
  const double all = sine(0.3, 1.2) + sine(1.5, 1.7) + sine(2.0, 2.6) + sine(4.0, 4.5);
  EXPECT_NEAR(parts.total()[0], all, 1e-9);
  EXPECT_NEAR(parts.total()[2], 0.9 + 0.2 + 0.6 + 0.5, 1e-9);
  std::array<double, 3> some{};
  parts.add_between(1.0, 2.2, some);
  EXPECT_NEAR(some[0], sine(1.0, 1.2) + sine(1.5, 1.7) + sine(2.0, 2.2), 1e-9);
}

}  // namespace trochoid::numerics::piecewise_integral_test
