#include <gtest/gtest.h>
#include <trochoid/numerics/spectrum.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace trochoid::numerics::spectrum_test {

TEST(Spectrum, IsTheSumThatItStandsFor) {
  std::vector<double> x;
  for (int j = 0; j < 30; ++j) x.push_back(std::sin(0.7 * j) + 0.1 * j);
  const auto X = real_spectrum(x);
  ASSERT_EQ(X.size(), 16U);
  for (std::size_t k = 0; k < X.size(); ++k) {
    std::complex<double> sum;
    for (std::size_t j = 0; j < x.size(); ++j) {
      sum += x[j] *
             std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(j * k) / 30.0);
    }
    EXPECT_NEAR(std::abs(X[k] - sum), 0.0, 1e-12) << k;
  }
  EXPECT_THROW(real_spectrum(std::vector<double>(7)), std::invalid_argument);
}

TEST(Spectrum, FastLengthsHaveSmallFactors) {
  EXPECT_EQ(fast_length(2), 2U);
  EXPECT_EQ(fast_length(1025), 1024U);
  EXPECT_EQ(fast_length(51200), 51200U);
  EXPECT_EQ(fast_length(10007), 10000U);
}

}  // namespace trochoid::numerics::spectrum_test
