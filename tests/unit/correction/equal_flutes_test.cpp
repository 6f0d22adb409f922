#include "paper_case.h"

#include <trochoid/correction/equal_flutes.h>
#include <trochoid/correction/estimator_model.h>
#include <trochoid/correction/plan.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trochoid::correction::equal_flutes_test {

namespace {

const std::vector<double> four = {10e-6, -4e-6, 6e-6, -12e-6};

RigidCut four_teeth() {
  return {slot_with(four), steep_law()};
}

/// The paper's machine with four teeth, so shallow that it does not chatter.
Setting four_on_the_table() {
  MovingCut cut = moving_case(0.0);
  cut.setup = slot_with(four);
  cut.setup.cut.a_p = 0.3e-3;
  return known_setting(cut, {}, RunoutEstimate::known);
}

}  // namespace

/// Of a sine nothing better is found from any start; harmonics leave nothing.
TEST(EqualFlutes, FourTeethNeedMoreThanASine) {
  const RigidCut cut = four_teeth();
  const Amplitude sine = equal_flutes(Target::peak_force, cut, Shape::sine, {});
  ASSERT_TRUE(sine.optimum);
  EXPECT_GT(sine.peak_difference, 0.005);
  EXPECT_EQ(sine.optimum->optimality, Optimality::limit_of_one_axis);
  EXPECT_FALSE(sine.optimum->proven);
  EXPECT_EQ(sine.optimum->starts, 4);
  EXPECT_EQ(sine.optimum->agreeing, 4);
  for (const Shape shape : {Shape::square, Shape::quintic, Shape::harmonics}) {
    const Amplitude a = equal_flutes(Target::peak_force, cut, shape, {.harmonics = 3});
    ASSERT_TRUE(a.optimum) << name_of(shape);
    EXPECT_LT(a.peak_difference, 2e-3) << name_of(shape);
    EXPECT_EQ(a.optimum->optimality, Optimality::equal) << name_of(shape);
    EXPECT_TRUE(a.optimum->proven);
  }
}

/// A table that follows late and too little, which the quick model does not know.
TEST(EqualFlutes, TheExactModelDecides) {
  const RigidCut cut = four_teeth();
  const auto distorted = [&](const PeriodicMotion& X) {
    Harmonics late = harmonics_of(X, 9);
    double n = 0;
    for (auto& c : late.c) {
      n += 1;
      c *= std::polar(0.9, -0.25 * n);
    }
    return cut.peaks(late);
  };
  const Amplitude blind =
      equal_flutes(Target::peak_force, cut, Shape::harmonics, {.harmonics = 3});
  EXPECT_GT(peak_difference(distorted(blind.motion)), 0.008);
  const Amplitude seen = equal_flutes(Target::peak_force, cut, Shape::harmonics,
                                      {.harmonics = 3}, {.exact = distorted});
  EXPECT_LT(peak_difference(distorted(seen.motion)), 2e-3);
  EXPECT_TRUE(seen.optimum && seen.optimum->proven);
}

TEST(EqualFlutes, LeastSquaresOfHarmonicsIsProvenToBeTheLeast) {
  const RigidCut cut = four_teeth();
  for (const int n : {1, 3, 7}) {
    const AxisLimits limits = axis_limits(cut, n);
    EXPECT_GT(limits.one_axis, 1e-6);
    EXPECT_LE(limits.one_axis_bound, limits.one_axis * (1 + 1e-12));
    EXPECT_NEAR(limits.one_axis_bound, limits.one_axis, 1e-9 * limits.one_axis);
    EXPECT_NEAR(limits.two_axes_bound, limits.two_axes, 1e-9 * limits.two_axes);
    EXPECT_LT(limits.two_axes, limits.one_axis);
    // No other motion of these harmonics comes below the bound.
    Harmonics other =
        std::get<Harmonics>(table_motion(cut, Shape::harmonics, {.harmonics = n}));
    EXPECT_NEAR(chip_rms(cut, other), limits.one_axis, 1e-12);
    other.c[0] += std::complex<double>(0.5e-6, -0.2e-6);
    EXPECT_GT(chip_rms(cut, other), limits.one_axis_bound);
  }
  const Amplitude a =
      equal_flutes(Target::least_squares, cut, Shape::harmonics, {.harmonics = 3});
  ASSERT_TRUE(a.optimum);
  EXPECT_EQ(a.optimum->optimality, Optimality::limit_of_one_axis);
  EXPECT_TRUE(a.optimum->proven);
}

TEST(EqualFlutes, FourTeethOnTheMachineAreEqualWithHarmonics) {
  const Setting s = four_on_the_table();
  EXPECT_GT(peak_difference(moving_flutes(s.cut, Harmonics{}).flutes), 0.09);
  const Plan plan = plan_correction(
      s, {.strategy = Method::inverse, .shape = Shape::harmonics, .harmonics = 3});
  ASSERT_TRUE(plan.ok) << plan.reason;
  EXPECT_LT(peak_difference(moving_flutes(s.cut, plan.command.wave).flutes), 0.01);
  EXPECT_TRUE(plan.limits.ok);
}

/// Each flute's own peak is one level away from the others.
TEST(EqualFlutes, MayMakeTheFlutesOwnForcesEqual) {
  const RigidCut cut = four_teeth();
  const auto own = [&](const PeriodicMotion& X) {
    double least = 1e9;
    double most = 0.0;
    for (const Flute& f : cut.peaks(X)) {
      least = std::min(least, f.own_peak_y);
      most = std::max(most, f.own_peak_y);
    }
    return (most - least) / most;
  };
  EXPECT_GT(own(Harmonics{}), 0.25);
  const Amplitude a = equal_flutes(Target::own_force, cut, Shape::square, {});
  EXPECT_LT(own(a.motion), 2e-3);
  EXPECT_GT(a.peak_difference, 0.001) << "equal forces are not equal sums of two";
}

/// Each entry against a step a hundred times as long, where peaks are nearly linear.
TEST(EstimatorModel, TellsWhatAWaveAndAToothChange) {
  const Setting s = four_on_the_table();
  const TrochoidEstimatorConfig config = estimator_for(s, Harmonics{}).value();
  EXPECT_EQ(config.teeth, 4);
  EXPECT_EQ(config.harmonics, 3);
  EXPECT_NEAR(config.most_m, 30e-6, 1e-12);
  for (int j = 0; j < 4; ++j) {  // in a slot with four teeth: 45 to 135 deg
    EXPECT_NEAR(config.start_rev[j], 0.125 + 0.25 * j, 1e-9);
  }
  const RigidCut cut(s.cut.setup, s.cut.law);
  const auto v_of = [](const std::vector<Flute>& flutes) {
    double mean = 0.0;
    for (const Flute& f : flutes) {
      mean += f.peak_y / 4;
    }
    std::vector<double> v;
    for (const Flute& f : flutes) {
      v.push_back(f.peak_y / mean - 1);
    }
    return v;
  };
  Harmonics command;
  command.c = {{0.0, 0.0}, {0.0, -1e-6}};  // a sine of the second harmonic
  const auto X = table_response(s.cut.plant, command, s.cut.setup.cut.Omega, 60);
  const auto with = v_of(cut.peaks(X));
  const auto without = v_of(cut.peaks(Harmonics{}));
  for (std::size_t j = 0; j < 4; ++j) {
    EXPECT_NEAR((with[j] - without[j]) / 1e-6, config.wave_model[j][3], 0.05 * 1e4)
        << j;
  }
  double row = 0.0;
  for (int i = 0; i < 4; ++i) {
    row += config.runout_model[1][i];
  }
  EXPECT_NEAR(row, 0.0, 50.0) << "all teeth longer by the same is no runout";
  EXPECT_GT(config.runout_model[1][1], 1e3);
}

}  // namespace trochoid::correction::equal_flutes_test
