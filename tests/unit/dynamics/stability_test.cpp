#include "milling_cut.h"

#include <trochoid/dynamics/stability.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace trochoid::dynamics::stability_test {

StabilityProblem benchmark(double depth_mm) {
  StabilityProblem p{.setup = straight_cut(2, geometry::Slot{}),
                     .law = benchmark_law(),
                     .system = benchmark_system()};
  p.setup.cut.a_p = depth_mm * unit::mm;
  return p;
}

TEST(Stability, OfTheBenchmarkWithItsLimitAndFrequencies) {
  const Stability stable = stability(benchmark(0.2));
  EXPECT_EQ(stable.verdict, StabilityVerdict::stable);
  EXPECT_NEAR(std::abs(stable.multiplier.value), 0.8197427843, 1e-6);
  EXPECT_NEAR(stable.period, pi, 1e-12) << "all teeth are alike";
  EXPECT_FALSE(stable.limit) << "no deeper cut than that of the case was asked for";
  EXPECT_TRUE(stable.cuts);
  EXPECT_FALSE(stable.floor) << "of a power law only";
  ASSERT_FALSE(stable.lines.empty());
  EXPECT_EQ(stable.lines.front().share, 1.0);

  const Stability unstable = stability(benchmark(0.5));
  EXPECT_EQ(unstable.verdict, StabilityVerdict::unstable);
  EXPECT_NEAR(std::abs(unstable.multiplier.value), 1.0739755867, 1e-6);
  ASSERT_TRUE(unstable.limit);
  EXPECT_GT(unstable.limit->limit.depth, 0.2 * unit::mm);
  EXPECT_LT(unstable.limit->limit.depth, 0.5 * unit::mm);
  EXPECT_NEAR(std::abs(unstable.limit->limit.multiplier), 1.0, 1e-5);
  EXPECT_FALSE(unstable.limit->lines.empty());
  EXPECT_TRUE(unstable.limit_curve.empty()) << "no diagram was asked for";
}

TEST(Stability, NearTheLimitIsMarginal) {
  StabilityProblem p = benchmark(0.5);
  p.options.margin = 0.1;
  EXPECT_EQ(stability(p).verdict, StabilityVerdict::marginal);
}

TEST(Stability, AVerdictThatHangsOnTheFloorOfThePowerLawIsMarginal) {
  StabilityProblem p = benchmark(0.5);
  p.law = force::Power{.K_t1 = 230e6, .K_r1 = 80e6, .m_t = 0.4, .m_r = 0.4};
  p.options.margin = 1e-9;
  p.options.chip_floor = 20e-6;
  const Stability at_first = stability(p);
  ASSERT_TRUE(at_first.floor && at_first.limit);
  EXPECT_NE(at_first.floor->at_half, at_first.floor->at_twice);
  EXPECT_TRUE(at_first.floor->decided);
  p.setup.cut.a_p = at_first.limit->limit.depth;  // the other floors are on either side
  const Stability near = stability(p);
  EXPECT_FALSE(near.floor->decided);
  EXPECT_EQ(near.verdict, StabilityVerdict::marginal);
}

TEST(Stability, OfADiagramIsThatOfItsPoints) {
  StabilityProblem p = benchmark(0.2);
  p.spindle_speeds = {5000 * unit::rpm, 9000 * unit::rpm};
  p.depths = {0.2 * unit::mm, 0.5 * unit::mm, 3 * unit::mm};
  std::string told;
  const Stability s = stability(p, [&](const char* what, double) { told = what; });
  EXPECT_EQ(told, "limit");
  ASSERT_EQ(s.lobes.multiplier.size(), 6U);
  EXPECT_NEAR(std::abs(s.lobes.multiplier[0]), 0.8197427843, 1e-5);
  EXPECT_NEAR(std::abs(s.lobes.multiplier[1]), 1.0739755867, 1e-5);
  EXPECT_EQ(s.greatest_depth, 3 * unit::mm);
  ASSERT_TRUE(s.limit);
  ASSERT_FALSE(s.limit_curve.empty());
  EXPECT_NEAR(s.limit_curve.front().limit.depth, s.limit->limit.depth,
              1e-4 * s.limit->limit.depth);
  EXPECT_NEAR(s.limit_curve.front().chatter_frequency, s.limit->lines[0].frequency,
              0.1);
}

TEST(Stability, WithoutACutIsThatOfTheDamping) {
  StabilityProblem p = benchmark(0.2);
  p.setup.cut.engagement = geometry::Band{6 * unit::mm, 8 * unit::mm};
  const Stability s = stability(p);
  EXPECT_FALSE(s.cuts);
  const double seconds = s.period / p.setup.cut.Omega;
  EXPECT_NEAR(std::abs(s.multiplier.value), std::exp(-0.011 * 2 * pi * 922 * seconds),
              1e-6);
}

TEST(LinearGrowth, IsTheMultiplierOfAWholeTurn) {  // [D-8]
  const StabilityProblem p = benchmark(0.5);
  const auto found = linear_growth(p.setup, p.law, p.system);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, std::pow(1.0739755867, 2), 1e-5);
}

TEST(LinearGrowth, IsNotLookedForOverManyVibrations) {
  StabilityProblem p = benchmark(0.5);
  p.setup.cut.Omega = 60 * unit::rpm;  // 461 vibrations from tooth to tooth
  EXPECT_FALSE(linear_growth(p.setup, p.law, p.system));
}

}  // namespace trochoid::dynamics::stability_test
