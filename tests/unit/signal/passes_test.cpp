#include <trochoid/signal/passes.h>

#include "made_pass.h"

#include <gtest/gtest.h>

namespace trochoid::signal::passes_test {

/// One record after the other.
Samples joined(const Samples& a, const Samples& b) {
  Samples out = a;
  for (std::size_t c = 0; c < 3; ++c) {
    out.channel[c].insert(out.channel[c].end(), b.channel[c].begin(),
                          b.channel[c].end());
  }
  const double end = a.angle.back() + turn / a_turn;
  for (const double phi : b.angle) out.angle.push_back(end + phi);
  return out;
}

// [S-6]
TEST(Passes, TellAirEntryAndSteadyCutApart) {
  const auto s = make({});
  const Passes found = passes_of(s.channel, s.angle);
  ASSERT_EQ(found.air.size(), 2u);
  EXPECT_EQ(found.air[0].begin, 0u);
  EXPECT_LE(found.air[0].end, 20u * a_turn);
  EXPECT_GE(found.air[0].end, 18u * a_turn);
  EXPECT_GE(found.air[1].begin, 65u * a_turn);
  EXPECT_EQ(found.air[1].end, s.angle.size());
  // 20 idle turns and 5 of entry; the last of these has 90 % of the force.
  ASSERT_EQ(found.steady.size(), 1u);
  EXPECT_GE(found.steady[0].begin, 24u * a_turn);
  EXPECT_LE(found.steady[0].begin, 25u * a_turn);
  EXPECT_LE(found.steady[0].end, 65u * a_turn);
  EXPECT_GE(found.steady[0].end, 64u * a_turn);
}

TEST(Passes, AreTheWholeOfARecordThatOnlyCuts) {
  for (const int cutting : {2, 3, 40}) {
    const auto s = make({.before = 0, .entering = 0, .cutting = cutting, .after = 0});
    const Passes found = passes_of(s.channel, s.angle);
    EXPECT_TRUE(found.air.empty());
    ASSERT_EQ(found.steady.size(), 1u);
    EXPECT_EQ(found.steady[0].begin, 0u);
    EXPECT_EQ(found.steady[0].end, s.angle.size());
  }
}

TEST(Passes, AreFoundOneByOne) {
  const auto s = joined(make({.before = 8, .entering = 0, .cutting = 20, .after = 8}),
                        make({.before = 0, .entering = 2, .cutting = 30, .after = 0}));
  const Passes found = passes_of(s.channel, s.angle);
  EXPECT_EQ(found.air.size(), 2u);
  ASSERT_EQ(found.steady.size(), 2u);
  // Within the cut, less a turn at most: a window with air in it may look like most.
  EXPECT_NEAR(static_cast<double>(found.steady[0].begin), 8.5 * a_turn, 0.5 * a_turn);
  EXPECT_NEAR(static_cast<double>(found.steady[0].end), 27.5 * a_turn, 0.5 * a_turn);
  EXPECT_NEAR(static_cast<double>(found.steady[1].begin), 38.0 * a_turn, 1.0 * a_turn);
  EXPECT_EQ(found.steady[1].end, s.angle.size());
}

TEST(Passes, AreFoundInALotOfAir) {
  const auto s = make({.before = 200, .entering = 0, .cutting = 6, .after = 100});
  const Passes found = passes_of(s.channel, s.angle);
  ASSERT_EQ(found.steady.size(), 1u);
  EXPECT_GE(found.steady[0].begin, 200u * a_turn);
  EXPECT_LE(found.steady[0].end, 206u * a_turn);
  EXPECT_GE(found.steady[0].size(), 4u * a_turn);
}

TEST(Passes, LeaveAnEntryWithoutAirOut) {
  const auto s = make({.before = 0, .entering = 6, .cutting = 20, .after = 0});
  const Passes found = passes_of(s.channel, s.angle);
  EXPECT_TRUE(found.air.empty());
  ASSERT_EQ(found.steady.size(), 1u);
  EXPECT_GE(found.steady[0].begin, 5u * a_turn);
  EXPECT_LE(found.steady[0].begin, 6u * a_turn);
  EXPECT_EQ(found.steady[0].end, s.angle.size());
}

TEST(Passes, AreNotEndedByMissingSamples) {
  auto s = make({.before = 0, .entering = 0, .cutting = 40, .after = 0});
  for (std::size_t i = 20 * a_turn; i < s.angle.size(); ++i) s.angle[i] += 30 * turn;
  const Passes found = passes_of(s.channel, s.angle);
  EXPECT_TRUE(found.air.empty());
  ASSERT_EQ(found.steady.size(), 1u);
  EXPECT_EQ(found.steady[0].size(), s.angle.size());
}

TEST(Passes, AreNotEndedByATurnThatVariesLess) {
  auto s = make({.before = 0, .entering = 0, .cutting = 60, .after = 0});
  for (auto& channel : s.channel) {
    for (std::size_t i = 30 * a_turn; i < 31 * a_turn; ++i) channel[i] *= 0.5;
  }
  const Passes found = passes_of(s.channel, s.angle);
  ASSERT_EQ(found.steady.size(), 1u);
  EXPECT_EQ(found.steady[0].size(), s.angle.size());
}

TEST(Passes, AreNotToldFromAFewSamplesATurn) {
  std::mt19937 random(3);
  std::normal_distribution<double> white(0.0, 1.0);
  Samples s;
  for (int i = 0; i < 4000; ++i) {
    s.angle.push_back(i * turn / 5.3);
    for (auto& channel : s.channel) channel.push_back(white(random));
  }
  const Passes found = passes_of(s.channel, s.angle);
  EXPECT_TRUE(found.air.empty());
  EXPECT_EQ(found.steady[0].size(), s.angle.size());
}

TEST(Passes, NeedOneAngleASample) {
  EXPECT_THROW(passes_of({{{1.0}, {1.0}, {1.0}}}, {}), std::invalid_argument);
}

TEST(Passes, DoNotTakeALighterCutForAir) {
  auto s = make({.before = 0, .entering = 0, .cutting = 40, .after = 0});
  for (auto& channel : s.channel) {
    for (std::size_t i = 0; i < 15u * a_turn; ++i) channel[i] *= 0.35;
  }
  EXPECT_TRUE(passes_of(s.channel, s.angle).air.empty());
}

TEST(Passes, DoNotTakeASlowEntryForAir) {
  const auto s = make({.before = 10, .entering = 60, .after = 0});
  const auto parts = passes_of(s.channel, s.angle).air;
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_LE(parts[0].end, 11u * a_turn);
}

}  // namespace trochoid::signal::passes_test
