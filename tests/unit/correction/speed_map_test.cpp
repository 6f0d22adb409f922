#include "paper_case.h"

#include <trochoid/correction/speed_map.h>

#include <gtest/gtest.h>

#include <cmath>

namespace trochoid::correction::speed_map_test {

namespace {

enum CurveOf : std::size_t {
  sine_plain,
  sine_lead,
  sine_inverse,
  square_lead,
  quintic_chosen,
  this_case
};

/// The paper's cut with a plan of its rigid tool.
SpeedMap paper_map(const CorrectionOptions& options) {
  const Setting s = known_setting(moving_case(27.8e-6), {}, RunoutEstimate::known);
  return speed_map(s, plan_correction(s, options), options);
}

}  // namespace

TEST(SpeedMap, SetsThisCaseBesideFiveUsualStrategies) {
  const SpeedMap map = paper_map(
      {.peak_to_peak = 26e-6, .spindle_speeds = {1200 * unit::rpm, 6000 * unit::rpm}});
  ASSERT_EQ(map.curves.size(), 6U);
  EXPECT_EQ(map.curves[sine_plain].name, "sine_plain");
  EXPECT_EQ(map.curves[quintic_chosen].name, "quintic_chosen");
  EXPECT_EQ(map.curves[this_case].name, "this_case");
  for (const Curve& curve : map.curves) {
    EXPECT_EQ(curve.points.size(), 2U);
    EXPECT_EQ(curve.chosen.size(), curve.name == "quintic_chosen" ? 2U : 0U);
  }
}

/// What the actuator is late grows with the speed; the inverse takes it into account.
TEST(SpeedMap, AFasterSpindleNeedsABetterStrategy) {
  const SpeedMap map = paper_map(
      {.peak_to_peak = 26e-6,
       .spindle_speeds = {100 * unit::rpm, 3000 * unit::rpm, 6000 * unit::rpm}});
  const auto left = [&](CurveOf curve, std::size_t speed) {
    return map.curves[curve].points[speed].peak_difference;
  };
  EXPECT_LT(left(sine_plain, 0), 0.01);
  EXPECT_GT(left(sine_plain, 1), left(sine_plain, 0));
  EXPECT_GT(left(sine_plain, 2), left(sine_lead, 2) + 0.05);
  EXPECT_LT(left(sine_inverse, 2), 0.001);
  const auto highest = [&](CurveOf curve) { return map.curves[curve].highest; };
  EXPECT_GT(highest(sine_lead), highest(sine_plain));
  EXPECT_GT(highest(sine_inverse), highest(sine_plain));
  EXPECT_EQ(highest(sine_inverse), map.Omega.back()) << "the stroke is long enough";
}

TEST(SpeedMap, AllowsMoreSpeedWhereMoreMayBeLeft) {
  CorrectionOptions options{.peak_to_peak = 26e-6,
                            .allowed_difference = 0.05,
                            .spindle_speeds = {100 * unit::rpm, 9000 * unit::rpm}};
  const double strict = paper_map(options).curves[sine_plain].highest;
  options.allowed_difference = 0.2;
  EXPECT_GT(paper_map(options).curves[sine_plain].highest, 1.1 * strict);
  EXPECT_GT(strict, options.spindle_speeds.front());
}

/// The plan is made on the moving cut: there its peaks are equal, on a rigid one not.
TEST(SpeedMap, MayLookAtTheCutThatGivesWay) {
  CorrectionOptions options{.strategy = Method::lead,
                            .spindle_speeds = {1200 * unit::rpm, 2400 * unit::rpm}};
  const auto left = [](const SpeedMap& map, std::size_t speed) {
    return map.curves[this_case].points[speed].peak_difference;
  };
  const SpeedMap rigid = paper_map(options);
  EXPECT_EQ(rigid.cut, MapCut::rigid);
  options.map_cut = MapCut::moving;
  const SpeedMap moving = paper_map(options);
  EXPECT_EQ(moving.cut, MapCut::moving);
  EXPECT_LT(left(moving, 0), 0.003);
  EXPECT_GT(left(moving, 1), left(moving, 0));
  EXPECT_GT(std::abs(left(moving, 1) - left(rigid, 1)), 1e-4);
  for (const Curve& curve : moving.curves) {
    EXPECT_GE(curve.highest, 0.0) << curve.name;
    EXPECT_LE(curve.highest, moving.Omega.back()) << curve.name;
  }
}

TEST(SpeedMap, SetsTheSpindleBesideTheTable) {
  CorrectionOptions options{.peak_to_peak = 26e-6,
                            .spindle_speeds = {200 * unit::rpm, 1200 * unit::rpm}};
  EXPECT_FALSE(paper_map(options).spindle);
  options.spindle = SpindleDrive{.inertia = 5e-4, .torque = 100.0};
  const SpeedMap map = paper_map(options);
  ASSERT_EQ(map.curves.size(), 7U);
  const Curve& curve = map.curves[5];
  EXPECT_EQ(curve.name, "spindle_sine");
  // A slow spindle is easily turned unevenly: two flutes always look eccentric.
  EXPECT_LT(curve.points[0].peak_difference, 0.05);
  EXPECT_GT(curve.points[1].peak_difference, curve.points[0].peak_difference + 0.05);
  ASSERT_TRUE(map.spindle);
  EXPECT_LT(map.spindle->part, 1.0);
}

TEST(SpeedMap, OfNoSpeedsIsEmpty) {
  const SpeedMap map = paper_map({.peak_to_peak = 26e-6});
  EXPECT_TRUE(map.curves.empty());
}

}  // namespace trochoid::correction::speed_map_test
