#include <trochoid/signal/drift.h>

#include "made_pass.h"

#include <gtest/gtest.h>

#include <optional>

namespace trochoid::signal::drift_test {

std::optional<Drift> drift_of(const Samples& s) {
  const Passes passes = passes_of(s.channel, s.angle);
  return idle_drift(s.channel, s.angle, passes.air, longest_steady(passes));
}

// [S-4]
TEST(IdleDrift, IsFoundBeforeAndAfterTheCut) {
  const auto s = make({});
  const auto drift = drift_of(s);
  ASSERT_TRUE(drift);
  EXPECT_TRUE(drift->sloped);
  // 3600 idle samples with 1 N of noise: 0.02 N; at the ends less than 0.05 N.
  EXPECT_NEAR(drift->channel[0].first, 15.0, 0.2);
  EXPECT_NEAR(drift->channel[0].last, -25.0, 0.2);
  EXPECT_NEAR(drift->channel[1].first, 7.0, 0.2);
  EXPECT_NEAR(drift->channel[2].last, -50.0, 0.2);
  EXPECT_GT(drift->channel[0].first_se, 0.0);
  EXPECT_LT(drift->channel[0].first_se, 0.1);
  EXPECT_GT(drift->se_in_cut[0], 0.0);
  EXPECT_LT(drift->se_in_cut[0], drift->channel[0].first_se);
}

TEST(IdleDrift, HasNoSlopeFromAShortAirCutAtOneEnd) {
  auto s = make({.before = 6, .after = 0});
  for (std::size_t i = 0; i < s.angle.size(); ++i) {  // no drift here
    s.channel[0][i] +=
        40.0 * static_cast<double>(i) / static_cast<double>(s.angle.size());
  }
  const auto drift = drift_of(s);
  ASSERT_TRUE(drift);
  EXPECT_FALSE(drift->sloped);
  EXPECT_NEAR(drift->channel[0].first, 15.0, 0.3);
  EXPECT_EQ(drift->channel[0].first, drift->channel[0].last);
}

TEST(IdleDrift, IsNotFoundWhereTheToolAlwaysCuts) {
  const auto s = make({.before = 0, .entering = 0, .after = 0});
  EXPECT_FALSE(drift_of(s));
  // Nor where it never does, nor in too few revolutions.
  const auto idle = make({.before = 40, .entering = 0, .cutting = 0, .after = 0});
  EXPECT_FALSE(drift_of(idle));
  const auto few = make({.before = 1, .entering = 0, .cutting = 2, .after = 0});
  EXPECT_FALSE(drift_of(few));
}

TEST(IdleDrift, OfOneTurnIsKnownAsWellAsItsNoiseLets) {
  const Samples s = make({});
  const Part turn{5 * a_turn, 6 * a_turn + 1};
  const auto drift =
      idle_drift(s.channel, s.angle, std::vector{turn}, {25 * a_turn, 60 * a_turn});
  ASSERT_TRUE(drift);
  EXPECT_NEAR(drift->se_in_cut[1], 1.0 / std::sqrt(double{a_turn}), 0.02);
}

TEST(IdleDrift, IsExactWithoutNoise) {
  const auto s = make({.noise = 0.0});
  const auto drift = drift_of(s);
  ASSERT_TRUE(drift);
  EXPECT_NEAR(drift->channel[0].first, 15.0, 1e-9);
  EXPECT_NEAR(drift->channel[0].last, -25.0, 1e-9);
}

TEST(RemoveDrift, TakesTheLineOut) {
  auto s = make({.noise = 0.0});
  const auto drift = drift_of(s);
  ASSERT_TRUE(drift);
  remove_drift(s.channel, *drift);
  EXPECT_NEAR(s.channel[0].front(), 0.0, 1e-9);
  EXPECT_NEAR(s.channel[0].back(), 0.0, 1e-9);
  EXPECT_NEAR(s.channel[0][40 * a_turn + 25], 200.0, 1e-9);
}

}  // namespace trochoid::signal::drift_test
