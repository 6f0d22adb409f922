#include "paper_case.h"

#include <trochoid/correction/speed_map.h>

#include <gtest/gtest.h>

namespace trochoid::correction {

namespace {

enum Curve : std::size_t {
  sine_plain,
  sine_lead,
  sine_inverse,
  square_lead,
  this_case
};

/// The paper's cut with a plan of its rigid tool.
SpeedMap paper_map(const CorrectionOptions& options) {
  const Setting s = known_setting(moving_case(27.8e-6), {}, RunoutEstimate::known);
  return speed_map(s, plan_correction(s, options), options);
}

}  // namespace

TEST(SpeedMap, SetsThisCaseBesideFourUsualStrategies) {
  const SpeedMap map = paper_map(
      {.peak_to_peak = 26e-6, .spindle_speeds = {1200 * unit::rpm, 6000 * unit::rpm}});
  ASSERT_EQ(map.strategies.size(), 5U);
  EXPECT_EQ(map.strategies[sine_plain].name, "sine_plain");
  EXPECT_EQ(map.strategies[this_case].name, "this_case");
  EXPECT_EQ(map.points.size(), 10U);
  EXPECT_EQ(map.highest.size(), 5U);
}

/// What the actuator is late grows with the speed; the inverse takes it into account.
TEST(SpeedMap, AFasterSpindleNeedsABetterStrategy) {
  const SpeedMap map = paper_map(
      {.peak_to_peak = 26e-6,
       .spindle_speeds = {100 * unit::rpm, 3000 * unit::rpm, 6000 * unit::rpm}});
  const auto left = [&](Curve curve, std::size_t speed) {
    return map.points[curve * map.Omega.size() + speed].peak_difference;
  };
  EXPECT_LT(left(sine_plain, 0), 0.01);
  EXPECT_GT(left(sine_plain, 1), left(sine_plain, 0));
  EXPECT_GT(left(sine_plain, 2), left(sine_lead, 2) + 0.05);
  EXPECT_LT(left(sine_inverse, 2), 0.001);
  EXPECT_GT(map.highest[sine_lead], map.highest[sine_plain]);
  EXPECT_GT(map.highest[sine_inverse], map.highest[sine_plain]);
  EXPECT_EQ(map.highest[sine_inverse], map.Omega.back()) << "the stroke is long enough";
}

TEST(SpeedMap, AllowsMoreSpeedWhereMoreMayBeLeft) {
  CorrectionOptions options{.peak_to_peak = 26e-6,
                            .allowed_difference = 0.05,
                            .spindle_speeds = {100 * unit::rpm, 9000 * unit::rpm}};
  const double strict = paper_map(options).highest[sine_plain];
  options.allowed_difference = 0.2;
  EXPECT_GT(paper_map(options).highest[sine_plain], 1.1 * strict);
  EXPECT_GT(strict, options.spindle_speeds.front());
}

TEST(SpeedMap, OfNoSpeedsIsEmpty) {
  const SpeedMap map = paper_map({.peak_to_peak = 26e-6});
  EXPECT_TRUE(map.strategies.empty());
  EXPECT_TRUE(map.points.empty());
}

}  // namespace trochoid::correction
