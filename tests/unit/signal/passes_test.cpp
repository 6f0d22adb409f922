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
  // 20 idle turns and 5 of entry.
  ASSERT_EQ(found.steady.size(), 1u);
  EXPECT_GE(found.steady[0].begin, 25u * a_turn);
  EXPECT_LE(found.steady[0].begin, 27u * a_turn);
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
  EXPECT_GE(found.steady[0].begin, 6u * a_turn);
  EXPECT_LE(found.steady[0].begin, 8u * a_turn);
  EXPECT_EQ(found.steady[0].end, s.angle.size());
}

/// A slot of four flutes: its force hardly changes over the turn, while in the entry, a
/// radius of feed, it changes a lot.
Samples four_flutes(int entering, int cutting, double noise) {
  std::mt19937 random(5);
  std::normal_distribution<double> white(0.0, noise);
  Samples s;
  const int air = 12;
  const int turns = 2 * air + entering + cutting;
  for (int i = 0; i < turns * a_turn; ++i) {
    const double phi = i * turn / a_turn;
    const double into = (phi / turn - air) / entering;
    const double cuts = phi / turn < turns - air ? std::clamp(into, 0.0, 1.0) : 0.0;
    // What is not yet in cut is the sides of the slot: the force is missing there.
    const double missing = 0.4 * std::pow(1.0 - cuts, 1.5);
    const double wave = cuts > 0.0 ? 10.0 + 400.0 * missing : 0.0;
    const double mean = cuts > 0.0 ? 200.0 * (1.0 - missing) : 0.0;
    s.angle.push_back(phi);
    s.channel[0].push_back(40.0 + mean + wave * std::cos(4.0 * phi) + white(random));
    s.channel[1].push_back(-mean + wave * std::sin(4.0 * phi) + white(random));
    s.channel[2].push_back(0.2 * mean + white(random));
  }
  return s;
}

// [S-8]
TEST(Passes, LeaveTheWholeOfAnEntryOut) {
  const auto s = four_flutes(30, 60, 2.0);
  const Passes found = passes_of(s.channel, s.angle);
  ASSERT_EQ(found.steady.size(), 1u);
  // The last turns of the entry lack less than half a per cent.
  EXPECT_GE(found.steady[0].begin, 39u * a_turn);
  EXPECT_LE(found.steady[0].begin, 44u * a_turn);
  EXPECT_GE(found.steady[0].end, 100u * a_turn);
  EXPECT_LE(found.steady[0].end, 102u * a_turn);
}

TEST(Passes, FindAirByItsMeanWhereNoiseHidesIt) {
  const auto s = four_flutes(30, 60, 20.0);
  const Passes found = passes_of(s.channel, s.angle);
  ASSERT_EQ(found.air.size(), 2u);
  EXPECT_EQ(found.air[0].begin, 0u);
  EXPECT_GE(found.air[0].end, 9u * a_turn);
  EXPECT_LE(found.air[0].end, 12u * a_turn);
  EXPECT_GE(found.air[1].begin, 102u * a_turn);
  ASSERT_EQ(found.steady.size(), 1u);
  EXPECT_GE(found.steady[0].begin, 36u * a_turn);
  EXPECT_LE(found.steady[0].end, 102u * a_turn);
}

TEST(Passes, TakeNoPartOfACutForAirByItsMean) {
  auto s = make({.before = 0, .entering = 0, .cutting = 60, .after = 0, .noise = 8.0});
  for (std::size_t i = 0; i < 20u * a_turn; ++i) s.channel[1][i] += 150.0;
  const Passes found = passes_of(s.channel, s.angle);
  EXPECT_TRUE(found.air.empty());
}

TEST(Passes, KeepACutThatWears) {
  auto s = make({.before = 10, .entering = 0, .cutting = 80, .after = 10});
  for (auto& channel : s.channel) {
    for (std::size_t i = 0; i < channel.size(); ++i) {
      channel[i] *=
          1.0 + 0.08 * static_cast<double>(i) / static_cast<double>(channel.size());
    }
  }
  const Passes found = passes_of(s.channel, s.angle);
  ASSERT_EQ(found.steady.size(), 1u);
  EXPECT_GE(found.steady[0].size(), 76u * a_turn);
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

TEST(Passes, LeaveThinChipsOfAnEntryOutOfTheAir) {
  // Forty turns of entry in noise of 6 N: seven of them vary less than twice the air.
  const Samples s = make({.before = 16, .entering = 40, .after = 16, .noise = 6.0});
  const Passes passes = passes_of(s.channel, s.angle);
  ASSERT_EQ(passes.air.size(), 2U);
  EXPECT_LE(passes.air[0].end, 16U * a_turn + a_turn / 2);
  EXPECT_GE(passes.air[0].end, 10U * a_turn);
  EXPECT_EQ(passes.air[0].begin, 0U);
  EXPECT_EQ(passes.air[1].end, s.angle.size());
}

TEST(Passes, DoNotTakeASlowEntryForAir) {
  const auto s = make({.before = 10, .entering = 60, .after = 0});
  const auto parts = passes_of(s.channel, s.angle).air;
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_LE(parts[0].end, 11u * a_turn);
}

}  // namespace trochoid::signal::passes_test
