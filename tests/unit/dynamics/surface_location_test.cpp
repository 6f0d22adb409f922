#include <trochoid/dynamics/surface_location.h>
#include <trochoid/force/forces.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace trochoid::dynamics::surface_location_test {

namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double k = 5e8;  // bends by less than the chip: the forces are the rigid ones

/// A tool so slow against its modes, and so damped, that it bends as under a weight.
MotionProblem slow_tool(geometry::Engagement engagement, double helix) {
  MotionProblem p;
  p.setup.cutter = {.profile = geometry::cylinder(10e-3),
                    .pitch = geometry::equal_pitch(2),
                    .helix = helix,
                    .lag_diameter = 10e-3};
  p.setup.runout.radial_offsets = {4e-6, -4e-6};
  p.setup.cut = {engagement, 2e-3, 0.05e-3, 0.5 * turn};
  p.setup.chip.model = chip::Model::radial;
  p.law = force::LinearEdge{.K_tc = 700e6, .K_rc = 250e6, .K_te = 9e3, .K_re = 7e3};
  const double mass = k / std::pow(turn * 1000, 2);
  const double damping = 2 * 0.7 * std::sqrt(k * mass);
  p.system.modes = {{mass, damping, k, 1, 0}, {mass, damping, k, 0, 1}};
  p.revolutions = 3;
  p.grid.steps_per_tooth = steps_needed(p);
  return p;
}

}  // namespace

TEST(SurfaceLocation, OfARigidToolIsItsRunout) {  // [T-10]
  MotionProblem p = slow_tool(geometry::Slot{}, 0.0);
  for (ChipMode& mode : p.system.modes) {
    mode.stiffness *= 1e8;
    mode.damping *= 1e4;
  }
  const auto walls = surface_location(p, motion(p), {0.0});
  ASSERT_EQ(walls.size(), 2U);
  EXPECT_EQ(walls[0].sigma, -1);
  EXPECT_EQ(walls[1].sigma, 1);
  for (const WallLocation& wall : walls) {
    ASSERT_EQ(wall.teeth.size(), 2U);
    EXPECT_NEAR(wall.teeth[0], -4e-6, 1e-12);  // the long tooth cuts too deep
    EXPECT_NEAR(wall.teeth[1], 4e-6, 1e-12);
    EXPECT_NEAR(wall.remains, -4e-6, 1e-12);
  }
}

/// Without helix the chip ends where the wall is made: only the edge force is left. The
/// short tooth cuts nothing there.
TEST(SurfaceLocation, OfASlowToolIsForceOverStiffness) {  // [T-10]
  const MotionProblem p = slow_tool(geometry::DownMilling{2e-3}, 0.0);
  const auto walls = surface_location(p, motion(p), {0.0});
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_EQ(walls[0].sigma, 1);
  const double pushed_off = 7e3 * 2e-3 / k;  // K_re a_p / k = 28 nm
  EXPECT_NEAR(walls[0].teeth[0], -4e-6 + pushed_off, 2e-10);
  EXPECT_NEAR(walls[0].teeth[1], 4e-6, 2e-10);
  EXPECT_NEAR(walls[0].remains, -4e-6 + pushed_off, 2e-10);
}

/// With helix the rest of the edge still cuts: force over stiffness at that moment.
TEST(SurfaceLocation, OfAHelixFollowsTheForceOfTheMoment) {  // [T-10]
  const MotionProblem p = slow_tool(geometry::UpMilling{3e-3}, 0.6);
  const std::vector<double> heights = {0.4e-3, 1.1e-3, 1.7e-3};
  const auto walls = surface_location(p, motion(p), heights);
  ASSERT_EQ(walls.size(), heights.size());
  for (std::size_t i = 0; i < heights.size(); ++i) {
    EXPECT_EQ(walls[i].sigma, -1);
    EXPECT_EQ(walls[i].height, heights[i]);
    const double lag = 2 * heights[i] * std::tan(0.6) / 10e-3;
    for (std::size_t j = 0; j < 2; ++j) {
      const std::vector<double> phi = {lag + turn / 2 * static_cast<double>(j)};
      const double F_y = force::forces(p.setup, p.law, phi, 1e-9).front()[1];
      EXPECT_TRUE(j == 1 || std::abs(F_y / k) > 5e-9);
      const double rho = j == 0 ? 4e-6 : -4e-6;
      EXPECT_NEAR(walls[i].teeth[j], -rho - F_y / k, 2e-10) << i << ' ' << j;
    }
  }
}

TEST(SurfaceLocation, NeedsAWholeTurn) {
  const MotionProblem p = slow_tool(geometry::Slot{}, 0.0);
  EXPECT_THROW(static_cast<void>(surface_location(p, Motion{}, {0.0})),
               std::invalid_argument);
}

}  // namespace trochoid::dynamics::surface_location_test
