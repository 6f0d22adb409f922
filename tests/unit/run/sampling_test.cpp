#include <trochoid/base/units.h>
#include <trochoid/run/simulate.h>

#include <gtest/gtest.h>

#include <numbers>

namespace trochoid::run::sampling_test {

TEST(SampledAngles, StartWhereTheyAreToldAndFillTheRevolutions) {
  const auto phi = sampled_angles(
      {.samples_per_rev = 720, .revolutions = 2, .start = 15 * unit::deg});
  ASSERT_EQ(phi.size(), 1440U);
  EXPECT_NEAR(phi.front(), 15 * unit::deg, 1e-15);
  EXPECT_NEAR(phi[1] - phi[0], 0.5 * unit::deg, 1e-15);
  EXPECT_NEAR(phi[720] - phi[0], 2 * std::numbers::pi, 1e-12);
}

TEST(SampledAngles, AreTheGivenOnesInTheirOrder) {
  const std::vector<double> given{3.0, 0.1, 2.0};
  EXPECT_EQ(sampled_angles({.samples_per_rev = 720, .angles = given}), given);
}

}  // namespace trochoid::run::sampling_test
