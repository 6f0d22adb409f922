#include <trochoid/signal/curved_drift.h>

#include "made_pass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace trochoid::signal::curved_drift_test {

using Channels = std::array<std::vector<double>, 3>;

double part_of(const Samples& s, std::size_t i) {
  return static_cast<double>(i) / static_cast<double>(s.angle.size());
}

/// @param drift  of the first channel over the record, from 0 to 1
Samples with(const Made& made, const std::function<double(double)>& drift) {
  Samples s = make(made);
  for (std::size_t i = 0; i < s.angle.size(); ++i) {
    s.channel[0][i] += drift(part_of(s, i));
  }
  return s;
}

CurvedDrift drift_of(const Samples& s) {
  const Passes passes = passes_of(s.channel, s.angle);
  return curved_drift(s.channel, s.angle, passes.air, longest_steady(passes));
}

/// Farthest from what it was without drift, in the cut [N].
double farthest(const Samples& drifting, const Samples& true_ones) {
  Channels now = drifting.channel;
  const Passes passes = passes_of(now, drifting.angle);
  remove_drift(now, drifting.angle, passes.air, longest_steady(passes));
  double most = 0.0;
  for (std::size_t i = 0; i < drifting.angle.size(); ++i) {
    const double x = part_of(drifting, i);
    const double line = 15.0 - 40.0 * x;
    if (x < 0.35 || x > 0.65) continue;
    most = std::max(most, std::abs(now[0][i] - (true_ones.channel[0][i] - line)));
  }
  return most;
}

double fading(double x) {
  return 40.0 * std::exp(-x / 0.3);
}

// [S-12]
TEST(CurvedDrift, IsTakenOutOfACutBetweenAir) {
  const Samples s = with({}, fading);
  const CurvedDrift drift = drift_of(s);
  EXPECT_GT(drift.terms[0].size(), 2u);
  EXPECT_GT(drift.bend[0], 1.0);
  EXPECT_GT(drift.offset_se[0], 0.0);
  EXPECT_LT(drift.offset_se[0], 2.0);
  EXPECT_LT(farthest(s, make({})), 4 * drift.offset_se[0]);  // of 40 N
}

TEST(CurvedDrift, IsNoneWhereALineDoesAsWell) {
  const CurvedDrift drift = drift_of(make({}));
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_TRUE(drift.terms[c].empty()) << c;
    EXPECT_EQ(drift.bend[c], 0.0);
  }
}

TEST(CurvedDrift, IsNotSeenInAForceThatGrows) {
  Samples s = make({.before = 5, .entering = 0, .cutting = 60, .after = 5});
  for (std::size_t i = 0; i < s.angle.size(); ++i) {
    const double x = part_of(s, i);
    if (x < 0.08 || x > 0.92) continue;
    const double more = 0.3 * x * x * 200.0 * std::pow(std::sin(s.angle[i]), 2);
    s.channel[0][i] += more;
    s.channel[1][i] -= more;
    s.channel[2][i] += 0.1 * more;
  }
  for (const auto& terms : drift_of(s).terms) EXPECT_TRUE(terms.empty());
}

TEST(CurvedDrift, HasNoConstantWithoutAir) {
  const CurvedDrift drift = drift_of(with({.before = 0, .entering = 0, .after = 0},
                                          [](double x) { return 0.3 * fading(x); }));
  ASSERT_GT(drift.terms[0].size(), 2u);
  EXPECT_EQ(drift.terms[0][0], 0.0);
  EXPECT_EQ(drift.offset_se[0], 0.0);
}

TEST(CurvedDrift, IsTakenOutOfAnyNumberOfChannels) {
  const Samples s = with({}, [](double x) { return 30.0 * fading(x); });
  const Passes passes = passes_of(s.channel, s.angle);
  const Part cut = longest_steady(passes);
  Channels three = s.channel;
  const RemovedDrift removed = remove_drift(three, s.angle, passes.air, cut);
  std::vector<std::vector<double>> four(s.channel.begin(), s.channel.end());
  four.push_back(s.channel[0]);
  const std::vector<double> se = remove_drift(four, s.angle, passes.air, cut);
  ASSERT_EQ(se.size(), 4U);
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_GT(se[c], 0.0);
    EXPECT_EQ(se[c], removed.offset_se[c % 3]);
    EXPECT_EQ(four[c], three[c % 3]);
  }
}

TEST(CurvedDrift, IsNotReadOffMeansThatJump) {
  Samples s = make({});
  for (std::size_t i = 0; i < s.angle.size(); ++i) {
    s.channel[0][i] += i % 900 < 450 ? 8.0 : -8.0;
  }
  EXPECT_TRUE(drift_of(s).terms[0].empty());
}

}  // namespace trochoid::signal::curved_drift_test
