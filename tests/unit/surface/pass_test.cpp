#include "made_wall.h"

#include <gtest/gtest.h>

namespace trochoid::surface::pass_test {

TEST(Pass, DownMillingFinishesAtPiUpMillingAtZero) {  // [E-1]
  const Side down = *side_of(geometry::DownMilling{1e-3});
  EXPECT_EQ(down.sigma, 1.0);
  EXPECT_DOUBLE_EQ(down.theta, pi);
  const Side up = *side_of(geometry::UpMilling{1e-3});
  EXPECT_EQ(up.sigma, -1.0);
  EXPECT_EQ(up.theta, 0.0);
}

TEST(Pass, ASlotAndABandHaveNoSingleWall) {  // [E-1]
  EXPECT_FALSE(side_of(geometry::Slot{}).has_value());
  EXPECT_FALSE(side_of(geometry::Band{}).has_value());
}

TEST(Pass, MaterialLeftIsPositiveOnBothSides) {  // [E-1]
  // an axis that stands 10 um off the wall leaves 10 um: down y_wall = -R, up +R
  for (const bool down : {true, false}) {
    const double sigma = side_of(made_cut(down).cut.engagement)->sigma;
    const double off = sigma * 10e-6;  // of the axis in y, away from the wall
    const double edge = off - sigma * 6e-3;
    const double beyond = -sigma * (edge + sigma * 6e-3);
    EXPECT_NEAR(-beyond, 10e-6, 1e-17);
    // the deflection of one moment of 1 N through 1 um/N says the same
    const numerics::PeriodicPieces moments(
        [&](double, std::span<double> out) {
          out[0] = 10 * sigma;  // F_y pushes off the wall
          out[1] = out[2] = 0.0;
        },
        {.period = 2 * pi, .allowed = {1e-9, 1e-9, 1e-9}});
    const auto delta = deflection(moments, std::array{1e-6}, sigma);
    EXPECT_NEAR(value_at(delta, 1.0), 10e-6, 1e-17);
  }
}

TEST(Pass, ATipEntersWhereTheRadialDepthBegins) {  // [E-12]
  MadeCut s = made_cut();
  s.cut.engagement = geometry::DownMilling{3e-3};  // half of the radius: 60 deg
  EXPECT_NEAR(entry_angle(s), 120 * unit::deg, 1e-14);
  s.cut.engagement = geometry::DownMilling{6e-3};
  EXPECT_NEAR(entry_angle(s), pi / 2, 1e-14);
  s.cut.engagement = geometry::DownMilling{12e-3};
  EXPECT_NEAR(entry_angle(s), 0.0, 1e-14);
  s.cut.engagement = geometry::UpMilling{3e-3};
  EXPECT_EQ(entry_angle(s), 0.0);
}

TEST(Pass, TeethStandBehindTheSpindleAngleByPitchAndLag) {  // [E-8]
  const auto places = edge_places(made_cut(), 1.5e-3);      // lag of 45 deg: z/R = 0.25
  ASSERT_EQ(places.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(places[i].R, 6e-3, 1e-17);
    EXPECT_NEAR(places[i].behind, 2 * pi / 3 * static_cast<double>(i) + 0.25, 1e-14);
  }
}

TEST(Pass, EccentricityMovesRadiusAndAngle) {  // [E-8]
  MadeCut s = with_runout(made_cut(), 60e-6, 0.25);
  const auto first = edge_places(s, 1.5e-3);
  EXPECT_NEAR(first[0].R, 6.06e-3, 1e-16);  // psi + lag - lambda = 0
  EXPECT_NEAR(first[1].R, 6e-3 - 30e-6, 1e-16);
  s.runout.order = geometry::EccentricityOrder::exact;
  const auto exact = edge_places(s, 1.5e-3);
  const double y = 6e-3 - 30e-6;                // along the tooth
  const double x = 60e-6 * std::sqrt(3.0) / 2;  // across
  EXPECT_NEAR(exact[1].R, std::hypot(x, y), 1e-16);
  EXPECT_NEAR(std::abs(exact[1].behind - first[1].behind), std::atan2(x, y), 1e-12);
}

TEST(Pass, TheLastToothToEnterOwnsTheSurface) {  // [E-7]
  const MadeCut s = made_cut();
  const auto tips = edge_places(s, 0.0);
  const double entry = entry_angle(s);
  const double third = 2 * pi / 3;
  // tooth 1 enters at phi = entry, tooth 2 a third of a turn later
  EXPECT_EQ(last_entered(tips, entry, entry + 0.01), 0U);
  EXPECT_EQ(last_entered(tips, entry, entry - 0.01), 2U);
  EXPECT_EQ(last_entered(tips, entry, entry + third - 0.01), 0U);
  EXPECT_EQ(last_entered(tips, entry, entry + third + 0.01), 1U);
  EXPECT_EQ(last_entered(tips, entry, entry + 2 * third + 0.01), 2U);
  EXPECT_EQ(last_entered(tips, entry, entry + 0.01 - 12 * pi), 0U);
}

TEST(Pass, JustEnteringCounts) {  // [E-7]
  const MadeCut s = made_cut();
  const auto tips = edge_places(s, 0.0);
  const double entry = entry_angle(s);
  for (int turns = 0; turns < 50; ++turns) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double phi = entry + 2 * pi * turns + 2 * pi / 3 * static_cast<double>(i);
      EXPECT_EQ(last_entered(tips, entry, phi), i) << turns;
    }
  }
}

}  // namespace trochoid::surface::pass_test
