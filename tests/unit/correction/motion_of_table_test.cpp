#include "paper_case.h"

#include <trochoid/correction/amplitude.h>
#include <trochoid/correction/equal_flutes.h>
#include <trochoid/correction/shapes.h>
#include <trochoid/correction/wall_marks.h>
#include <trochoid/force/forces.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace trochoid::correction {

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

TEST(RigidCut, AgreesWithTheForcesOfACutAtRest) {
  for (const auto& rho :
       {std::vector<double>{13e-6, -13e-6}, std::vector<double>{12e-6, -3e-6, -9e-6}}) {
    for (const chip::Model model :
         {chip::Model::none, chip::Model::feed, chip::Model::radial}) {
      for (const geometry::Engagement& engagement :
           {geometry::Engagement(geometry::Slot{}),
            geometry::Engagement(geometry::UpMilling{2e-3})}) {
        force::Setup setup = slot_with(rho);
        setup.cut.engagement = engagement;
        setup.chip.model = model;
        const RigidCut cut(setup, ordinary_law());
        std::vector<double> phi;
        for (int i = 0; i < 97; ++i) {
          phi.push_back(0.013 + turn * i / 97);
        }
        const auto want = force::forces(setup, ordinary_law(), phi, 1e-10);
        for (std::size_t i = 0; i < phi.size(); ++i) {
          const auto F = cut.force(still, phi[i]);
          for (std::size_t q = 0; q < 3; ++q) {
            EXPECT_NEAR(F[q], want[i][q], 1e-6) << phi[i];
          }
        }
      }
    }
  }
}

TEST(RigidCut, AgreesWithForcesOfUnequalPitchAndHelix) {
  force::Setup setup = slot_with({12e-6, -3e-6, -9e-6});
  setup.cutter.pitch = {1.9, 2.2, turn - 4.1};
  setup.cutter.helix = 0.5;
  setup.cut.a_p = 2e-3;
  const RigidCut cut(setup, ordinary_law(), 400);
  std::vector<double> phi;
  for (int i = 0; i < 41; ++i) {
    phi.push_back(0.013 + turn * i / 41);
  }
  const auto want = force::forces(setup, ordinary_law(), phi, 1e-9);
  for (std::size_t i = 0; i < phi.size(); ++i) {
    const auto F = cut.force(still, phi[i]);
    for (std::size_t q = 0; q < 3; ++q) {
      EXPECT_NEAR(F[q], want[i][q], 0.05) << phi[i];
    }
  }
}

TEST(RigidCut, TableAwayFromTheToolMakesTheChipThinner) {
  const RigidCut cut(slot_with({0.0, 0.0}), steep_law());
  const PeriodicMotion away = Harmonics{0.0, {{0.0, -5e-6}}};  // +5 um at 90 degrees
  EXPECT_GT(place_at(away, turn / 4), 0);
  EXPECT_NEAR(cut.chip(away, 0, turn / 4).h, 50e-6 - 10e-6, 1e-15);
  EXPECT_NEAR(cut.chip(away, 1, turn * 3 / 4).h, 50e-6 + 10e-6, 1e-15);
}

TEST(RigidCut, AllMaterialIsCutWhateverTheTableDoes) {
  for (const auto& rho :
       {std::vector<double>{13e-6, -13e-6}, std::vector<double>{40e-6, -30e-6},
        std::vector<double>{12e-6, -3e-6, -9e-6}}) {
    const RigidCut cut(slot_with(rho), steep_law());
    for (const Shape shape : shapes) {
      for (const double factor : {0.0, 0.5, 1.0, 2.5}) {
        double sum = 0.0;
        for (const Flute& f :
             cut.flutes(scaled(table_motion(cut, shape, {}), factor))) {
          sum += f.chip_area;
        }
        const double all = 2 * static_cast<double>(rho.size()) * 50e-6;
        EXPECT_NEAR(sum, all, 1e-7 * all) << static_cast<int>(shape) << ' ' << factor;
      }
    }
  }
}

TEST(RigidCut, PredictionIsWhatItsPartsSay) {
  const RigidCut cut(slot_with({12e-6, -3e-6, -9e-6}), ordinary_law());
  const PeriodicMotion x = table_motion(cut, Shape::sine, {});
  const Prediction p = cut.predict(x, 90);
  ASSERT_EQ(p.angle.size(), 90U);
  for (std::size_t i = 0; i < p.angle.size(); ++i) {
    const auto F = cut.force(x, p.angle[i]);
    for (std::size_t q = 0; q < 3; ++q) {
      EXPECT_NEAR(F[q], p.force[i][q], 1e-12);
      double sum = 0.0;
      for (const auto& flute : p.flute_force) {
        sum += flute[i][q];
      }
      EXPECT_NEAR(sum, F[q], 1e-12);
    }
    EXPECT_DOUBLE_EQ(p.table[i], place_at(x, p.angle[i]));
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_DOUBLE_EQ(p.chip[j][i], cut.chip(x, static_cast<int>(j), p.angle[i]).h);
    }
  }
}

TEST(RigidCut, CutsWhatIsLeftInTheLimits) {
  force::Setup setup = slot_with({30e-6, -30e-6});  // more runout than feed
  const auto idle = RigidCut(setup, steep_law()).flutes(still);
  EXPECT_EQ(idle[1].chip_area, 0.0);
  EXPECT_EQ(idle[1].peak_chip, 0.0);
  EXPECT_NEAR(idle[0].chip_area, 4 * 50e-6, 1e-12);
  EXPECT_NEAR(idle[0].peak_chip, 2 * 50e-6, 1e-12);
  const RigidCut one(slot_with({5e-6}), steep_law());
  for (const double theta : {0.3, 1.5, 2.9}) {
    EXPECT_NEAR(one.chip(still, 0, theta).h, 50e-6 * std::sin(theta), 1e-17);
  }
  setup = slot_with({13e-6, -13e-6});
  setup.cut.f_z = 0.0;
  EXPECT_EQ(RigidCut(setup, steep_law()).flutes(still)[0].peak_y, 0.0);
  setup.cut.f_z = 50e-6;
  setup.cut.a_p = 0.0;
  EXPECT_EQ(RigidCut(setup, steep_law()).flutes(still)[0].peak_y, 0.0);
}

TEST(WallMarks, TheLongestToothMakesTheWallWhateverTheTableDoes) {
  const double R = 4e-3;
  const RigidCut round(slot_with({0.0, 0.0}), steep_law());
  const WallMarks both = wall_marks(round, still, false);
  EXPECT_NEAR(both.share[0], 0.5, 0.01);
  EXPECT_NEAR(both.peak_to_valley, std::pow(50e-6, 2) / (8 * R), 2e-3 * 1e-7);
  const RigidCut cut(slot_with({13e-6, -13e-6}), steep_law());
  for (const bool exit : {false, true}) {
    for (const Shape shape : {Shape::sine, Shape::square}) {
      const WallMarks after = wall_marks(cut, table_motion(cut, shape, {}), exit);
      EXPECT_NEAR(after.share[0], 1.0, 1e-9);
      EXPECT_EQ(after.share[1], 0.0);
      EXPECT_NEAR(after.peak_to_valley, std::pow(100e-6, 2) / (8 * R), 5e-3 * 3.1e-7);
    }
  }
  // A runout as small as the marks themselves: the table moves the shorter one's aside.
  const RigidCut fine(slot_with({10e-9, -10e-9}), steep_law());
  const WallMarks before = wall_marks(fine, still, false);
  EXPECT_GT(before.share[1], 0.0);
  EXPECT_LT(before.share[1], 0.5);
  const PeriodicMotion cosine = Harmonics{0.0, {{5e-6, 0.0}}};
  const WallMarks moved = wall_marks(fine, cosine, false);
  EXPECT_GT(moved.peak_to_valley, before.peak_to_valley);
  // A table that stands 5 um ahead meets the tooth 5 um farther back.
  const WallMarks one =
      wall_marks(RigidCut(slot_with({0.0}), steep_law()), cosine, false);
  const auto top = std::max_element(one.depth.begin(), one.depth.end());
  EXPECT_NEAR(one.x[static_cast<std::size_t>(top - one.depth.begin())], 45e-6, 0.2e-6);
}

TEST(RigidCut, RefusesOtherCutters) {
  force::Setup setup = slot_with({0.0, 0.0});
  setup.cutter.profile = geometry::ball(8e-3);
  EXPECT_THROW(RigidCut(setup, steep_law()), std::invalid_argument);
}

TEST(RigidCut, RefusesWhatIsNoCut) {
  const force::Setup good = slot_with({0.0, 0.0});
  EXPECT_THROW(RigidCut(good, steep_law(), 0), std::invalid_argument);
  EXPECT_THROW(RigidCut(good, force::Power{.m_t = 1.0}), std::invalid_argument);
  force::Setup bad = good;
  bad.cut.f_z = -1e-6;
  EXPECT_THROW(RigidCut(bad, steep_law()), std::invalid_argument);
  bad = good;
  bad.cut.a_p = std::nan("");
  EXPECT_THROW(RigidCut(bad, steep_law()), std::invalid_argument);
  bad = good;
  bad.runout.radial_offsets[1] = std::nan("");
  EXPECT_THROW(RigidCut(bad, steep_law()), std::invalid_argument);
}

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

}  // namespace trochoid::correction
