#include <trochoid/numerics/fourier.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace trochoid::numerics::fourier_test {

/// Three functions with known coefficients, at n steps.
std::vector<double> sampled(int n) {
  std::vector<double> out;
  for (int k = 0; k < n; ++k) {
    const double x = 2.0 * std::numbers::pi * k / n;
    out.push_back(1.5 + 2.0 * std::cos(x) - 3.0 * std::sin(4.0 * x));
    out.push_back(-0.5 * std::sin(x) + 0.25 * std::cos(7.0 * x));
    out.push_back(4.0);
  }
  return out;
}

TEST(Fourier, FindsTheCoefficientsOfEachFunction) {
  const auto c = fourier_coefficients(sampled(16), 3, 7);
  ASSERT_EQ(c.size(), 15U * 3U);
  for (std::size_t i = 0; i < 15; ++i) {
    EXPECT_NEAR(c[3 * i], i == 0 ? 1.5 : i == 1 ? 2.0 : i == 8 ? -3.0 : 0.0, 1e-14);
    EXPECT_NEAR(c[3 * i + 1], i == 2 ? -0.5 : i == 13 ? 0.25 : 0.0, 1e-14);
    EXPECT_NEAR(c[3 * i + 2], i == 0 ? 4.0 : 0.0, 1e-14);
  }
}

TEST(Fourier, AFewHarmonicsAreThoseOfAll) {
  const auto all = fourier_coefficients(sampled(64), 3, 31);
  const auto few = fourier_coefficients(sampled(64), 3, 4);
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i], all[i]);
}

TEST(Fourier, RefusesWhatItCannotTransform) {
  EXPECT_THROW(fourier_coefficients(sampled(12), 3, 4), std::invalid_argument);
  EXPECT_THROW(fourier_coefficients(sampled(16), 3, 8), std::invalid_argument);
  EXPECT_THROW(fourier_coefficients(sampled(16), 5, 2), std::invalid_argument);
  EXPECT_THROW(fourier_coefficients({}, 0, 0), std::invalid_argument);
}

}  // namespace trochoid::numerics::fourier_test
