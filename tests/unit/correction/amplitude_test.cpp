#include "paper_case.h"

#include <trochoid/correction/amplitude.h>
#include <trochoid/correction/equal_flutes.h>
#include <trochoid/correction/shapes.h>

#include <gtest/gtest.h>

#include <cmath>

namespace trochoid::correction::amplitude_test {

namespace {

const PeriodicMotion still = Harmonics{};
const std::vector<Shape> shapes = {Shape::square, Shape::sine, Shape::trapezoid,
                                   Shape::quintic, Shape::harmonics};

}  // namespace

TEST(Amplitude, EqualPeaksOfTwoTeeth) {
  for (const force::Power& law : {steep_law(), ordinary_law()}) {
    const RigidCut cut(slot_with({13e-6, -13e-6}), law);
    EXPECT_GT(peak_difference(cut.peaks(still)), 0.35);
    for (const Shape shape :
         {Shape::square, Shape::sine, Shape::trapezoid, Shape::quintic}) {
      const Amplitude a =
          amplitude_for(Target::peak_force, cut, table_motion(cut, shape, {}));
      ASSERT_TRUE(a.ok) << a.reason;
      EXPECT_LT(a.peak_difference, 1e-6);
      // The peak is late, where the motion counts for less: more than 26 um are needed.
      const bool sine = shape == Shape::sine;
      EXPECT_GT(a.peak_to_peak, sine ? 27.2e-6 : 26.5e-6);
      EXPECT_LT(a.peak_to_peak, sine ? 28.4e-6 : 26.9e-6);
    }
  }
}

TEST(Amplitude, EqualChipsNeedMuchMoreThanEqualPeaks) {
  const RigidCut cut(slot_with({13e-6, -13e-6}), steep_law());
  const auto ratio = [&](Shape shape) {
    const Amplitude a =
        amplitude_for(Target::chip_area, cut, table_motion(cut, shape, {}));
    EXPECT_TRUE(a.ok);
    EXPECT_LT(area_difference(a.flutes), 1e-6);
    return a.factor;
  };
  EXPECT_NEAR(ratio(Shape::square), 1.42, 0.005);
  EXPECT_NEAR(ratio(Shape::sine), 1.73, 0.005);
}

TEST(Amplitude, OneFactorForMoreTeethIsTheBestOne) {
  force::Setup setup = slot_with({12e-6, -3e-6, -9e-6});
  setup.cut.engagement = geometry::UpMilling{2e-3};
  const RigidCut cut(setup, ordinary_law());
  const auto unevenness = [&](const PeriodicMotion& x) {
    const auto flutes = cut.peaks(x);
    double mean = 0.0;
    for (const Flute& f : flutes) {
      mean += f.peak_y / 3;
    }
    double sum = 0.0;
    for (const Flute& f : flutes) {
      sum += std::pow(f.peak_y / mean - 1, 2);
    }
    return sum;
  };
  for (const Shape shape : shapes) {
    const PeriodicMotion x = table_motion(cut, shape, {});
    const Amplitude a = amplitude_for(Target::peak_force, cut, x);
    ASSERT_TRUE(a.ok) << a.reason;
    for (const double factor : {0.0, 0.5, 0.9, 1.0, 1.1, 1.5, 2.0}) {
      EXPECT_LE(unevenness(a.motion), unevenness(scaled(x, factor)) + 1e-6);
    }
  }
}

TEST(Amplitude, ALevelForEachToothMakesThemAlike) {
  for (const auto& rho : {std::vector<double>{12e-6, -3e-6, -9e-6},
                          std::vector<double>{7e-6, -2e-6, 4e-6, 11e-6},
                          std::vector<double>{5e-6, -8e-6, 3e-6, 1e-6, -4e-6, 2e-6}}) {
    for (const geometry::Engagement& engagement :
         {geometry::Engagement(geometry::Slot{}),
          geometry::Engagement(geometry::UpMilling{2e-3}),
          geometry::Engagement(geometry::DownMilling{1e-3})}) {
      force::Setup setup = slot_with(rho);
      setup.cut.engagement = engagement;
      const RigidCut cut(setup, ordinary_law());
      EXPECT_GT(peak_difference(cut.peaks(still)), 0.1);
      const Amplitude a = equal_flutes(Target::peak_force, cut, Shape::square, {});
      ASSERT_TRUE(a.ok) << a.reason;
      EXPECT_LT(a.peak_difference, 1e-3);
      if (rho.size() == 3) {  // a sine has two numbers
        const Amplitude s = equal_flutes(Target::peak_force, cut, Shape::sine, {});
        EXPECT_LT(s.peak_difference, 1e-3);
      }
    }
  }
}

TEST(Amplitude, ALevelForEachToothIsOneFactorOfTwo) {
  const RigidCut cut(slot_with({13e-6, -13e-6}), steep_law());
  const Amplitude a = equal_flutes(Target::peak_force, cut, Shape::quintic, {});
  const Amplitude b =
      amplitude_for(Target::peak_force, cut, table_motion(cut, Shape::quintic, {}));
  EXPECT_EQ(a.factor, b.factor);
  EXPECT_EQ(a.peak_difference, b.peak_difference);
  const RigidCut three(slot_with({12e-6, -3e-6, -9e-6}), steep_law());
  const Amplitude area = equal_flutes(Target::chip_area, three, Shape::square, {});
  EXPECT_LT(area_difference(area.flutes), 1e-3);
}

TEST(Amplitude, LeastSquaresLeavesTheLeast) {
  const RigidCut cut(slot_with({12e-6, -3e-6, -9e-6}), steep_law());
  for (const Shape shape : shapes) {
    const Amplitude a =
        amplitude_for(Target::least_squares, cut, table_motion(cut, shape, {}));
    ASSERT_TRUE(a.ok);
    const double least = chip_rms(cut, a.motion);
    EXPECT_GT(chip_rms(cut, scaled(a.motion, 1.001)), least);
    EXPECT_GT(chip_rms(cut, scaled(a.motion, 0.999)), least);
  }
}

TEST(Amplitude, NoRunoutNeedsNoMotion) {
  const RigidCut cut(slot_with({0.0, 0.0}), steep_law());
  const Amplitude a =
      amplitude_for(Target::peak_force, cut, table_motion(cut, Shape::sine, {}));
  EXPECT_FALSE(a.ok);
  EXPECT_LT(a.peak_difference, 1e-9);
}

}  // namespace trochoid::correction::amplitude_test
