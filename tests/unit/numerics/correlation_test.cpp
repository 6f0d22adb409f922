#include <gtest/gtest.h>
#include <trochoid/numerics/correlation.h>

#include <cmath>
#include <vector>

namespace trochoid::numerics::correlation_test {

/// Whatever is left over beside whole vectors.
TEST(Correlation, IsTheSumAtEveryShift) {
  for (const std::size_t n : {1U, 3U, 8U, 33U, 64U, 120U}) {
    std::vector<double> a(n);
    std::vector<double> twice(2 * n);
    for (std::size_t i = 0; i < n; ++i) {
      a[i] = std::sin(1.0 + static_cast<double>(i * i));
      twice[i] = twice[n + i] = std::cos(2.0 + 3.0 * static_cast<double>(i));
    }
    for (const std::size_t shifts : {std::size_t{1}, n}) {
      std::vector<double> out(shifts);
      correlate(a, twice, out);
      for (std::size_t s = 0; s < shifts; ++s) {
        double sum = 0.0;
        for (std::size_t i = 0; i < n; ++i) sum += a[i] * twice[(i + s) % n];
        EXPECT_NEAR(out[s], sum, 1e-13) << n << " " << s;
      }
    }
  }
}

}  // namespace trochoid::numerics::correlation_test
