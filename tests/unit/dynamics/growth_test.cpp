#include <trochoid/dynamics/growth.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace trochoid::dynamics::growth_test {

namespace {

using Turns = std::vector<std::array<double, 2>>;

/// q where a small vibration has one pair of multipliers, |mu| e^(+-i angle).
Turns pair(double growth, double angle, int turns, double size = 1e-8) {
  Turns once;
  for (int n = 0; n < turns; ++n) {
    const double r = size * std::pow(growth, n);
    once.push_back(
        {2e-6 + r * std::cos(angle * n), 1e-6 + 0.3 * r * std::sin(angle * n)});
  }
  return once;
}

}  // namespace

TEST(Growth, OfAPairIsItsModulus) {  // [T-11]
  for (const double growth : {0.6, 0.97, 1.153, 1.8}) {
    const auto found = growth_per_turn(pair(growth, 2.3, 14), 1e-3);
    ASSERT_TRUE(found) << growth;
    EXPECT_NEAR(*found, growth, 1e-9);
  }
}

TEST(Growth, OfASingleMultiplierIsItself) {  // [T-11]
  for (const double mu : {-1.4, -0.7, 1.2, 0.5}) {
    Turns once;
    for (int n = 0; n < 12; ++n) {
      once.push_back({1e-6 + 1e-8 * std::pow(mu, n), 0.0});
    }
    const auto found = growth_per_turn(once, 1e-3);
    ASSERT_TRUE(found) << mu;
    EXPECT_NEAR(*found, std::abs(mu), 1e-6);
  }
}

/// After the teeth have begun to leave the cut the vibration stays as large as it is.
TEST(Growth, IsReadWhileTheVibrationIsSmall) {  // [T-11]
  Turns once = pair(1.5, 1.1, 16);
  for (int n = 0; n < 30; ++n) {
    once.push_back({4e-5 * std::cos(1.9 * n), 4e-5 * std::sin(2.4 * n)});
  }
  const auto found = growth_per_turn(once, 5e-6);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, 1.5, 1e-6);
}

TEST(Growth, IsNotReadFromWhatFollowsNoRecurrence) {  // [T-11]
  Turns once;
  double x = 0.3141;
  for (int n = 0; n < 40; ++n) {
    x = 3.9 * x * (1 - x);
    once.push_back({1e-6 * x, 0.0});
  }
  EXPECT_FALSE(growth_per_turn(once, 1e-3));
  EXPECT_FALSE(growth_per_turn(pair(1.1, 2.3, 30), 1e-12));  // none is small
  EXPECT_FALSE(growth_per_turn(pair(1.1, 2.3, 4), 1e-3));
  EXPECT_FALSE(growth_per_turn(Turns(20, {1e-6, 0.0}), 1e-3));  // nothing moves
}

TEST(Growth, LateChangeTellsWhatDiesOutFromWhatStays) {
  const auto dying = late_change(pair(0.8, 2.3, 41));
  const auto staying = late_change(pair(1.0, 2.3, 41));
  ASSERT_TRUE(dying && staying);
  EXPECT_NEAR(*dying, std::pow(0.8, 10), 0.03);
  EXPECT_NEAR(*staying, 1.0, 0.05);
  EXPECT_FALSE(late_change(pair(1.0, 2.3, 8)));
}

}  // namespace trochoid::dynamics::growth_test
