#include <trochoid/base/units.h>
#include <trochoid/run/angles.h>
#include <trochoid/run/chip_answer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace trochoid::run {
namespace {

force::Setup setup_of(const geometry::Profile& profile) {
  force::Setup out;
  out.cutter.profile = profile;
  out.cutter.pitch = geometry::equal_pitch(2);
  out.cutter.helix = 30 * unit::deg;
  out.cutter.lag_diameter = profile.D;
  out.runout.radial_offsets = {10e-6, 0.0};
  out.cut = {.engagement = geometry::Slot{}, .a_p = 2e-3, .f_z = 50e-6, .Omega = 90.0};
  return out;
}

TEST(SampledAngles, StartWhereTheyAreToldAndFillTheRevolutions) {
  const auto phi = sampled_angles(
      {.samples_per_rev = 720, .revolutions = 2, .start = 15 * unit::deg});
  ASSERT_EQ(phi.size(), 1440U);
  EXPECT_NEAR(phi.front(), 15 * unit::deg, 1e-15);
  EXPECT_NEAR(phi[1] - phi[0], 0.5 * unit::deg, 1e-15);
  EXPECT_NEAR(phi[720] - phi[0], 2 * std::numbers::pi, 1e-12);
}

TEST(SampledAngles, AreTheGivenOnesInTheirOrder) {
  const std::vector<double> given{3.0, 0.1, 2.0};
  EXPECT_EQ(sampled_angles({.samples_per_rev = 720, .angles = given}), given);
}

TEST(ChipTable, HasARowForEveryToothAngleAndHeight) {
  const auto setup = setup_of(geometry::cylinder(10e-3));
  const std::vector<double> angles{10 * unit::deg, 90 * unit::deg};
  const std::vector<double> heights{0.0, 1e-3, 2e-3};
  const base::Table table = chip_table(setup, angles, heights);
  ASSERT_EQ(table.columns.size(), 4U);
  EXPECT_EQ(table.columns[0].name, "tooth");
  EXPECT_EQ(table.columns[3].name, "h_mm");
  const auto& tooth = table.columns[0].values;
  ASSERT_EQ(tooth.size(), 12U);
  EXPECT_EQ(tooth.front(), 1.0);
  EXPECT_EQ(tooth.back(), 2.0);
  for (std::size_t i = 0; i < 12; ++i) {
    const bool flat = std::abs(table.columns[1].values[i] - 90) < 1e-9;
    const double h = table.columns[3].values[i];
    if (flat) {
      EXPECT_NEAR(h, tooth[i] == 1 ? 0.060 : 0.040, 1e-5);
    }
  }
}

TEST(SliceAnswer, FindsTheThickestChipOfEachTooth) {
  const SliceAnswer answer = slice_answer(setup_of(geometry::cylinder(10e-3)), 0.0);
  ASSERT_EQ(answer.teeth.size(), 2U);
  EXPECT_NEAR(answer.teeth[0].peak_chip, 60e-6, 1e-8);
  EXPECT_NEAR(answer.teeth[1].peak_chip, 40e-6, 1e-8);
  EXPECT_NEAR(answer.removal.removed / answer.removal.available, 1.0, 2e-5);
}

TEST(SliceAnswer, IgnoresTheRunoutOfTheModelWithoutOne) {
  auto setup = setup_of(geometry::cylinder(10e-3));
  setup.chip.model = chip::Model::none;
  const SliceAnswer answer = slice_answer(setup, 0.0);
  EXPECT_NEAR(answer.teeth[0].peak_chip, 50e-6, 1e-12);
  EXPECT_NEAR(answer.teeth[1].peak_chip, 50e-6, 1e-12);
}

TEST(DefaultHeight, IsTheTipUnlessTheEdgeReachesTheAxis) {
  EXPECT_EQ(default_height(setup_of(geometry::cylinder(10e-3))), 0.0);
  EXPECT_EQ(default_height(setup_of(geometry::bull_nose(10e-3, 1e-3))), 0.0);
  EXPECT_EQ(default_height(setup_of(geometry::ball(10e-3))), 2e-3);
}

TEST(ChipCurve, HasOneColumnATooth) {
  const base::Table curve = chip_curve(setup_of(geometry::cylinder(10e-3)), 0.0);
  ASSERT_EQ(curve.columns.size(), 3U);
  double largest = 0.0;
  for (const double h : curve.columns[1].values) largest = std::max(largest, h);
  EXPECT_GT(largest, 0.0599);
}

}  // namespace
}  // namespace trochoid::run
