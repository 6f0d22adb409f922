#include <trochoid/force/process_damping.h>

#include <gtest/gtest.h>

namespace trochoid::force::process_damping_test {

TEST(ProcessDamping, IsThatOfTheVolumeUnderTheLand) {  // [F-16]
  // 80 um of land at a slope of 1 in 50: a triangle of 80 um by 1.6 um over 2 mm
  const double slope = 0.02;
  const double volume = 0.5 * 80e-6 * (80e-6 * slope) * 2e-3;
  const Terms terms = damping_terms({80e-6, 3e13, 0.25});
  EXPECT_NEAR(terms.K[1] * 2e-3 * slope, 3e13 * volume, 1e-12);
  EXPECT_NEAR(terms.K[0] * 2e-3 * slope, 0.25 * 3e13 * volume, 1e-12);
  EXPECT_EQ(terms.K[2], 0.0);
  EXPECT_FALSE(terms.form.power);
  EXPECT_FALSE(terms.form.edge);
}

TEST(ProcessDamping, NeedsALandAndAMaterial) {  // [F-16]
  EXPECT_TRUE((ProcessDamping{80e-6, 3e13, 0.0}.acts()));
  EXPECT_FALSE((ProcessDamping{0.0, 3e13, 0.3}.acts()));
  EXPECT_FALSE((ProcessDamping{80e-6, 0.0, 0.3}.acts()));
}

}  // namespace trochoid::force::process_damping_test
