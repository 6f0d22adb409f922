#include <trochoid/base/units.h>
#include <trochoid/force/slice.h>
#include <trochoid/force/statistics.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trochoid::force::slice_test {

Setup setup_of(const geometry::Profile& profile) {
  Setup out;
  out.cutter.profile = profile;
  out.cutter.pitch = geometry::equal_pitch(2);
  out.cutter.helix = 30 * unit::deg;
  out.cutter.lag_diameter = profile.D;
  out.runout.radial_offsets = {10e-6, 0.0};
  out.cut = {.engagement = geometry::Slot{}, .a_p = 2e-3, .f_z = 50e-6, .Omega = 90.0};
  return out;
}

TEST(ChipGrid, HasAChipForEveryToothAngleAndHeight) {
  const auto setup = setup_of(geometry::cylinder(10e-3));
  const std::vector<double> angles{10 * unit::deg, 90 * unit::deg};
  const std::vector<double> heights{0.0, 1e-3, 2e-3};
  const ChipGrid grid = chip_grid(setup, angles, heights);
  ASSERT_EQ(grid.h.size(), 12U);
  for (std::size_t k = 0; k < heights.size(); ++k) {
    EXPECT_NEAR(grid.h[3 + k], 60e-6, 1e-8) << "tooth 1 in front";
    EXPECT_NEAR(grid.h[9 + k], 40e-6, 1e-8) << "tooth 2 in front";
  }
}

TEST(Engagement, FindsTheThickestChipOfEachTooth) {
  const Engagement answer = engagement_at(setup_of(geometry::cylinder(10e-3)), 0.0);
  ASSERT_EQ(answer.teeth.size(), 2U);
  EXPECT_NEAR(answer.teeth[0].peak_chip, 60e-6, 1e-8);
  EXPECT_NEAR(answer.teeth[1].peak_chip, 40e-6, 1e-8);
  EXPECT_NEAR(answer.removal.removed / answer.removal.available, 1.0, 2e-5);
}

TEST(Engagement, IgnoresTheRunoutOfTheModelWithoutOne) {
  auto setup = setup_of(geometry::cylinder(10e-3));
  setup.chip.model = chip::Model::none;
  const Engagement answer = engagement_at(setup, 0.0);
  EXPECT_NEAR(answer.teeth[0].peak_chip, 50e-6, 1e-12);
  EXPECT_NEAR(answer.teeth[1].peak_chip, 50e-6, 1e-12);
}

TEST(RepresentativeHeight, IsTheTipUnlessTheEdgeReachesTheAxis) {
  EXPECT_EQ(representative_height(setup_of(geometry::cylinder(10e-3))), 0.0);
  EXPECT_EQ(representative_height(setup_of(geometry::bull_nose(10e-3, 1e-3))), 0.0);
  EXPECT_EQ(representative_height(setup_of(geometry::ball(10e-3))), 2e-3);
}

TEST(ChipCurve, HasOneCurveATooth) {
  const ChipCurve curve = chip_curve(setup_of(geometry::cylinder(10e-3)), 0.0);
  ASSERT_EQ(curve.h.size(), 2U);
  ASSERT_EQ(curve.h[0].size(), curve.theta.size());
  EXPECT_GT(*std::max_element(curve.h[0].begin(), curve.h[0].end()), 59.9e-6);
}

TEST(IdleTeeth, CutHardlyAnything) {
  force::Setup setup = setup_of(geometry::cylinder(10e-3));
  EXPECT_TRUE(idle_teeth(chip_curve(setup, 0.0)).empty());
  setup.runout.radial_offsets = {0.0, -0.9 * setup.cut.f_z};
  EXPECT_TRUE(idle_teeth(chip_curve(setup, 0.0)).empty());
  setup.runout.radial_offsets = {0.0, -1.2 * setup.cut.f_z};
  EXPECT_EQ(idle_teeth(chip_curve(setup, 0.0)), (std::vector<std::size_t>{1}));
}

TEST(ForceStatistics, AreThoseOfTheCourse) {
  const std::vector<Loads> loads = {{{1, 0, -2}, 3, 1}, {{3, 4, -2}, -1, 5}};
  const ForceStatistics s = force_statistics(loads);
  EXPECT_EQ(s.mean, (Vector3{2, 2, -2}));
  EXPECT_EQ(s.min, (Vector3{1, 0, -2}));
  EXPECT_EQ(s.max, (Vector3{3, 4, -2}));
  EXPECT_NEAR(s.rms[0], std::sqrt(5.0), 1e-15);
  EXPECT_EQ(s.peak_xy, 5.0);
  const MomentStatistics m = moment_statistics(loads);
  EXPECT_EQ(m.mean_torque, 1.0);
  EXPECT_EQ(m.peak_torque, 3.0);
  EXPECT_EQ(m.peak_bending, 5.0);
}

}  // namespace trochoid::force::slice_test
