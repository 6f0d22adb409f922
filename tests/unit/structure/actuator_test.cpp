#include <gtest/gtest.h>
#include <trochoid/structure/actuator.h>

#include <cmath>
#include <numbers>

namespace trochoid::structure::actuator_test {

constexpr double pi = std::numbers::pi;

TEST(Actuator, TwoLagsInARowAreTheProductOfTheirResponses) {  // [M-8]
  const auto actuator = from_time_constants(0.9, 0.002, 0.0005);
  for (const double omega : {0.0, 100.0, 3000.0}) {
    const std::complex<double> s(0.0, omega);
    const auto expected = 0.9 / (1.0 + 0.002 * s) / (1.0 + 0.0005 * s);
    EXPECT_NEAR(std::abs(response(actuator, omega) - expected), 0.0, 1e-15);
  }
}

TEST(Actuator, FrequencyAndDampingAreThoseItWasMadeFrom) {
  const auto actuator = from_frequency(1.0, 140.0, 0.7);
  EXPECT_NEAR(natural_frequency(actuator), 280 * pi, 1e-9);
  EXPECT_NEAR(damping_ratio(actuator), 0.7, 1e-14);
  EXPECT_FALSE(time_constants(actuator));
}

TEST(Actuator, TimeConstantsComeBackTheLongerFirst) {  // [M-9]
  const auto T = time_constants(from_time_constants(1.0, 0.0005, 0.002));
  ASSERT_TRUE(T);
  EXPECT_NEAR((*T)[0], 0.002, 1e-15);
  EXPECT_NEAR((*T)[1], 0.0005, 1e-15);
}

TEST(Actuator, ItsEquationHoldsForAHarmonicMotion) {  // [M-10]
  const auto actuator = from_frequency(0.8, 20.0, 1.3);
  const auto a = equation_coefficients(actuator);
  const std::complex<double> s(0.0, 55.0);
  const auto y = response(actuator, 55.0);
  EXPECT_NEAR(std::abs(a[2] * s * s * y + a[1] * s * y + a[0] * y - 1.0), 0.0, 1e-12);
}

TEST(Actuator, AStepSolvesTheEquationAtAnyDamping) {  // [M-11]
  for (const double zeta : {0.05, 0.999999, 1.0, 1.000001, 4.0}) {
    const auto actuator = from_frequency(0.9, 1 / (2 * pi), zeta);
    const auto a = equation_coefficients(actuator);
    for (const double t : {0.3, 1.0, 2.5, 7.0}) {
      constexpr double h = 1e-3;
      const double y = step_response(actuator, t);
      const double up = step_response(actuator, t + h);
      const double down = step_response(actuator, t - h);
      const double acceleration = (up - 2 * y + down) / (h * h);
      EXPECT_NEAR(a[2] * acceleration + a[1] * (up - down) / (2 * h) + a[0] * y, 1.0,
                  2e-6)
          << zeta << " " << t;
    }
    EXPECT_EQ(step_response(actuator, -1.0), 0.0);
    EXPECT_NEAR(step_response(actuator, 1e4), 0.9, 1e-12);
    // it starts from rest: y ~ gain t^2/2 for omega_n = 1
    EXPECT_NEAR(step_response(actuator, 1e-4), 0.9 * 0.5e-8, 1e-11);
  }
}

TEST(Actuator, TheGainAtItsHalfPowerFrequencyIsThreeDecibelsDown) {  // [M-12]
  for (const double zeta : {0.1, 0.7071, 1.0, 20.0}) {
    const auto actuator = from_frequency(3.0, 50.0, zeta);
    const double omega = 2 * pi * half_power_frequency(actuator);
    EXPECT_NEAR(std::abs(response(actuator, omega)), 3.0 / std::sqrt(2.0), 1e-12);
    for (const double lag : {0.1, pi / 4, pi / 2, 2.5}) {
      const double at = 2 * pi * lag_frequency(actuator, lag);
      EXPECT_NEAR(std::arg(response(actuator, at)), -lag, 1e-12);
    }
  }
}

TEST(Actuator, RiseTimeIsWhereTheStepFirstGetsThere) {
  for (const double zeta : {0.05, 1.0, 4.0}) {
    const auto actuator = from_frequency(2.0, 30.0, zeta);
    for (const double part : {0.1, 0.5, 0.98}) {
      const double t = rise_time(actuator, part);
      EXPECT_NEAR(step_response(actuator, t), 2.0 * part, 1e-10);
      for (int i = 0; i < 100; ++i) {
        EXPECT_LT(step_response(actuator, t * i / 100.0), 2.0 * part);
      }
    }
  }
}

TEST(Actuator, SlowCommandsAreLateByTheSumOfTheTimeConstants) {
  const auto actuator = from_time_constants(1.0, 0.003, 0.001);
  const double omega = 0.01;
  EXPECT_NEAR(-std::arg(response(actuator, omega)) / omega,
              low_frequency_delay(actuator), 1e-9);
}

}  // namespace trochoid::structure::actuator_test
