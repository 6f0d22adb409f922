#include "paper_case.h"

#include <trochoid/correction/shapes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace trochoid::correction::motion_of_table_test {

namespace {

constexpr double turn = 2 * std::numbers::pi;
const PeriodicMotion still = Harmonics{};
const std::vector<Shape> shapes = {Shape::square, Shape::sine, Shape::trapezoid,
                                   Shape::quintic, Shape::harmonics};

/// Offsets of an eccentricity alone.
std::vector<double> eccentric(int teeth, double e, double alpha) {
  std::vector<double> rho;
  for (int j = 0; j < teeth; ++j) {
    rho.push_back(e * std::cos(alpha + turn * j / teeth));
  }
  return rho;
}

}  // namespace

TEST(PeriodicMotion, HarmonicsOfATrapezoidAreThoseOfItsIntegral) {
  const RigidCut cut(slot_with({13e-6, -13e-6}), steep_law());
  for (const Shape shape : {Shape::square, Shape::trapezoid, Shape::quintic}) {
    const PeriodicMotion x = table_motion(cut, shape, {});
    const Harmonics h = harmonics_of(x, 9);
    for (int n = 1; n <= 9; ++n) {
      std::complex<double> sum = 0.0;
      constexpr int count = 200000;
      for (int i = 0; i < count; ++i) {
        const double phi = turn * (i + 0.5) / count;
        sum += place_at(x, phi) * std::polar(2.0 / count, -n * phi);
      }
      EXPECT_NEAR(std::abs(h.c[static_cast<std::size_t>(n) - 1] - sum), 0.0, 2e-14);
    }
  }
}

TEST(PeriodicMotion, DerivativesAreDifferenceQuotients) {
  const RigidCut cut(slot_with({12e-6, -3e-6, -9e-6}), steep_law());
  for (const Shape shape : shapes) {
    const PeriodicMotion x = table_motion(cut, shape, {});
    for (double phi = 0.3; phi < turn; phi += 0.7) {
      constexpr double d = 1e-5;
      const MotionPoint a = motion_at(x, phi - d);
      const MotionPoint b = motion_at(x, phi);
      const MotionPoint c = motion_at(x, phi + d);
      EXPECT_NEAR(b.slope, (c.x - a.x) / (2 * d), 1e-12);
      EXPECT_NEAR(b.curvature, (c.slope - a.slope) / (2 * d), 1e-11);
      EXPECT_NEAR(place_at(x, phi), b.x, 1e-18);
    }
  }
}

TEST(PeriodicMotion, IsAdvancedAndScaled) {
  const RigidCut cut(slot_with({13e-6, -13e-6}), steep_law());
  for (const Shape shape : shapes) {
    const PeriodicMotion x = table_motion(cut, shape, {});
    const PeriodicMotion y = advanced(scaled(x, 1.5), 0.4);
    for (double phi = 0.05; phi < turn; phi += 0.31) {
      EXPECT_NEAR(place_at(y, phi), 1.5 * place_at(x, phi + 0.4), 1e-18);
    }
  }
}

TEST(Levels, SumToZeroAndCancelEveryDifference) {
  const std::vector<double> rho = {7e-6, -2e-6, 4e-6, 11e-6};
  const std::vector<double> x = levels(rho);
  EXPECT_NEAR(std::accumulate(x.begin(), x.end(), 0.0), 0.0, 1e-18);
  // Chips at 90 degrees over the mark of any tooth before are those without runout.
  force::Setup setup = slot_with(rho);
  setup.cut.engagement = geometry::Band{-1e-4, 1e-4};  // one tooth at a time
  const RigidCut cut(setup, steep_law());
  const PeriodicMotion square = table_motion(cut, Shape::square, {});
  for (int j = 0; j < 4; ++j) {
    const double phi = turn / 4 + cut.psi()[static_cast<std::size_t>(j)];
    EXPECT_NEAR(cut.chip(square, j, phi).h, setup.cut.f_z, 1e-15);
    EXPECT_NEAR(place_at(square, phi), x[static_cast<std::size_t>(j)], 1e-18);
  }
}

TEST(Shapes, PassTheLevelsInTheMiddleOfEveryPass) {
  const std::vector<double> rho = {12e-6, -3e-6, -9e-6};
  for (const geometry::Engagement& engagement :
       {geometry::Engagement(geometry::Slot{}),
        geometry::Engagement(geometry::UpMilling{2e-3}),
        geometry::Engagement(geometry::DownMilling{1e-3})}) {
    force::Setup setup = slot_with(rho);
    setup.cut.engagement = engagement;
    const RigidCut cut(setup, steep_law());
    const double middle = (cut.arc().from + cut.arc().to) / 2;
    for (const Shape shape :
         {Shape::square, Shape::sine, Shape::trapezoid, Shape::quintic}) {
      const PeriodicMotion x = table_motion(cut, shape, {});
      for (std::size_t j = 0; j < 3; ++j) {  // a sine has as many unknowns as levels
        EXPECT_NEAR(place_at(x, cut.psi()[j] + middle), rho[j], 1e-15);
      }
    }
  }
}

TEST(Shapes, QuinticIsSmoothAndOneAndSevenEighthsAsSteepAsItsMean) {
  const RigidCut cut(slot_with({13e-6, -13e-6}), steep_law());
  const double width = 1.2;
  const Range range =
      range_of(table_motion(cut, Shape::quintic, {.transition = width}));
  EXPECT_NEAR(range.peak_to_peak(), 26e-6, 1e-15);
  EXPECT_NEAR(range.slope, 1.875 * 26e-6 / width, 1e-3 * 26e-6);
  EXPECT_TRUE(std::isfinite(range.curvature));
  EXPECT_TRUE(std::isinf(
      range_of(table_motion(cut, Shape::trapezoid, {.transition = width})).curvature));
  EXPECT_TRUE(std::isinf(range_of(table_motion(cut, Shape::square, {})).slope));
}

TEST(Shapes, ASineCancelsTheOrbitOfAnEccentricityAlongTheFeed) {
  for (const int teeth : {3, 4, 5}) {
    const double e = 10e-6;
    const double alpha = 0.7;
    const RigidCut cut(slot_with(eccentric(teeth, e, alpha)), steep_law());
    const PeriodicMotion x = table_motion(cut, Shape::sine, {});
    for (double phi = 0; phi < turn; phi += 0.37) {
      EXPECT_NEAR(place_at(x, phi), e * std::cos(phi - turn / 4 + alpha), 1e-15);
    }
  }
}

TEST(Shapes, ASineOfTwoTeethLeavesTheSquareOfTheCosine) {
  const double d = 26e-6;
  const RigidCut cut(slot_with({d / 2, -d / 2}), steep_law());
  const PeriodicMotion x = table_motion(cut, Shape::sine, {});
  for (double theta = 1.2; theta < 2.0; theta += 0.1) {  // bounded by the tooth before
    const double h = cut.chip(x, 0, theta).h;
    EXPECT_NEAR(h, 50e-6 * std::sin(theta) + d * std::pow(std::cos(theta), 2), 1e-15);
  }
}

TEST(Shapes, HarmonicsLeaveLessThanAnyOtherMotionOfAsMany) {
  for (const auto& rho :
       {std::vector<double>{13e-6, -13e-6}, std::vector<double>{12e-6, -3e-6, -9e-6},
        std::vector<double>{7e-6, -2e-6, 4e-6, 11e-6}}) {
    const RigidCut cut(slot_with(rho), steep_law());
    const PeriodicMotion best = table_motion(cut, Shape::harmonics, {.harmonics = 7});
    const double least = chip_rms(cut, best);
    for (const Shape shape : shapes) {
      const PeriodicMotion other =
          harmonics_of(table_motion(cut, shape, {.harmonics = 7}), 7);
      EXPECT_LE(least, chip_rms(cut, other) * (1 + 1e-9));
    }
    for (std::size_t n = 0; n < 7; ++n) {
      for (const std::complex<double> step :
           {std::complex<double>(1e-8, 0), std::complex<double>(0, 1e-8)}) {
        Harmonics near = std::get<Harmonics>(best);
        near.c[n] += step;
        EXPECT_GE(chip_rms(cut, near), least * (1 - 1e-12));
      }
    }
  }
}

TEST(Shapes, MultiplesOfTheTeethAreInvisible) {
  const RigidCut cut(slot_with({12e-6, -3e-6, -9e-6}), steep_law());
  const PeriodicMotion third = Harmonics{0.0, {0.0, 0.0, {5e-6, 3e-6}}};
  EXPECT_NEAR(chip_rms(cut, third), chip_rms(cut, still), 1e-15);
  const auto a = cut.flutes(third);
  const auto b = cut.flutes(still);
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_NEAR(a[j].peak_y, b[j].peak_y, 1e-9);
  }
}

TEST(Shapes, ASecondAxisServesTwoTeethAtOnce) {
  const RigidCut cut(slot_with({7e-6, -2e-6, 4e-6, 11e-6}), steep_law());
  const AxisLimits limits = axis_limits(cut, 11);
  EXPECT_EQ(limits.most_teeth, 2);
  EXPECT_LT(limits.one_axis, limits.uncorrected);
  EXPECT_LT(limits.two_axes, 0.8 * limits.one_axis);
  // Two teeth in a slot, each alone: a second axis turns the push along with the tooth,
  // and what is left of every chip falls with the harmonics.
  const RigidCut two(slot_with({13e-6, -13e-6}), steep_law());
  EXPECT_EQ(axis_limits(two, 11).most_teeth, 1);
  EXPECT_LT(axis_limits(two, 25).two_axes, 0.5 * axis_limits(two, 25).one_axis);
}

TEST(Shapes, FewerHarmonicsKeepTheMiddleOfThePass) {
  const RigidCut cut(slot_with({13e-6, -13e-6}), steep_law());
  const PeriodicMotion square = table_motion(cut, Shape::square, {});
  for (const int n : {1, 3, 5}) {
    EXPECT_NEAR(place_at(limited(cut, square, n), turn / 4), 13e-6, 1e-15);
  }
  EXPECT_GT(place_at(harmonics_of(square, 1), turn / 4), 16e-6);
}

}  // namespace trochoid::correction::motion_of_table_test
