#include "made_cut.h"

#include <trochoid/force/edge_curve.h>

#include <gtest/gtest.h>

namespace trochoid::force::bend_test {

MadeCut down_cut() {
  MadeCut s = slot(geometry::cylinder(12e-3), 3, 45);
  s.cut = {geometry::DownMilling{1e-3}, 3e-3, 0.2e-3, 90.0};
  s.chip.model = chip::Model::radial;
  s.runout = {.eccentricity = 4e-6, .angle = 0.8};
  return s;
}

TEST(Bend, ATiltedAxisShiftsEachHeightByItsOwn) {  // [E-10]
  const MadeCut s = down_cut();
  const Edges edges(s);
  Bend bend;
  bend.shift = [](double z) { return 0.1e-3 - 0.02 * z; };
  EdgeCurve bent(edges, &bend);
  for (const double z : {0.2e-3, 1.4e-3, 2.9e-3}) {
    MadeCut moved = s;
    const double limit = -5e-3 - bend.shift(z);
    moved.cut.engagement = geometry::Band{-1.0, limit};
    const Edges there(moved);
    EdgeCurve straight(there);
    int cutting = 0;
    for (const double phi : turn(400)) {
      bent.stand_at(phi, 2);
      straight.stand_at(phi, 2);
      EXPECT_NEAR(bent.state(z).chip.h, straight.state(z).chip.h, 1e-15);
      cutting += bent.state(z).active() ? 1 : 0;
    }
    EXPECT_GT(cutting, 20);
  }
}

TEST(Bend, TheAdvanceIsAskedForItsToothHeightAndAngle) {  // [E-10]
  MadeCut s = down_cut();
  s.runout = {};
  s.cut.engagement = geometry::Slot{};
  const Edges edges(s);
  Bend bend;
  bend.shift = [](double) { return 0.0; };
  bend.advance = [](double z, std::size_t tooth, double theta, std::span<double> out) {
    ASSERT_EQ(out.size(), 3U);
    out[0] = 1e-3 * z + 1e-6 * static_cast<double>(tooth) + 5e-6 * theta;
    out[1] = out[2] = 1.0;
  };
  EdgeCurve curve(edges, &bend);
  for (std::size_t tooth = 0; tooth < 3; ++tooth) {
    const double z = 1.3e-3;
    const double theta = 1.2;
    curve.stand_at(theta + edges.psi[tooth] + z / 6e-3, tooth);  // lag of 45 deg: z/R
    EXPECT_NEAR(curve.state(z).chip.h,
                0.2e-3 * std::sin(theta) + 1e-3 * z +
                    1e-6 * static_cast<double>(tooth) + 5e-6 * theta,
                1e-15);
  }
}

TEST(Bend, NoBendIsAStraightCutter) {  // [E-10]
  const Edges edges(down_cut());
  Bend bend;
  bend.shift = [](double) { return 0.0; };
  EdgeCurve bent(edges, &bend);
  EdgeCurve straight(edges);
  for (const double phi : turn(200)) {
    bent.stand_at(phi, 1);
    straight.stand_at(phi, 1);
    EXPECT_EQ(bent.state(1e-3).chip.h, straight.state(1e-3).chip.h);
  }
}

TEST(Bend, SeedsStandWhereTheEdgePassesTheStockAndTheFront) {  // [E-10]
  MadeCut s = down_cut();
  s.cut.a_p = 40e-3;  // the edge winds by 6.7 rad
  const Edges edges(s);
  EdgeCurve curve(edges);
  curve.stand_at(0.4, 1);
  std::vector<double> grid;
  curve.add_seeds(grid);
  // theta = 0.4 - psi - z/R, pi/2 and acos(-5/6), each once or twice
  std::vector<double> expected;
  for (const double target : {pi / 2, std::acos(-5.0 / 6.0)}) {
    for (int k = -3; k < 3; ++k) {
      const double z = 6e-3 * (0.4 - 2 * pi / 3 - target - 2 * pi * k);
      if (z > 0 && z < 40e-3) expected.push_back(z);
    }
  }
  std::sort(expected.begin(), expected.end());
  ASSERT_EQ(grid.size(), expected.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    EXPECT_NEAR(grid[i], expected[i], 1e-12);
  }
}

}  // namespace trochoid::force::bend_test
