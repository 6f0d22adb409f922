#include <trochoid/force/edge_curve.h>

#include <trochoid/base/units.h>
#include <trochoid/geometry/edge.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trochoid::force::edge_meetings_test {

force::Setup eccentric_ball(int teeth) {
  force::Setup setup;
  setup.cutter = geometry::end_mill(10 * unit::mm, teeth, 30 * unit::deg);
  setup.cutter.profile = geometry::ball(10 * unit::mm);
  setup.runout = {.eccentricity = 10 * unit::um, .angle = 0.7};
  setup.cut = {.engagement = geometry::Slot{},
               .a_p = 1 * unit::mm,
               .f_z = 40 * unit::um,
               .Omega = 90.0};
  return setup;
}

/// How far tooth k stands ahead of tooth j, in [-pi, pi] [rad].
double ahead(const Edges& edges, double s, std::size_t j, std::size_t k) {
  const EdgePoint p = edges.point(s);
  std::vector<geometry::EdgePosition> teeth(edges.psi.size());
  geometry::edge_positions(edges.setup.runout, edges.psi, p.meridian.r, p.lag, teeth);
  return std::remainder(
      edges.psi[j] - edges.psi[k] + teeth[k].epsilon - teeth[j].epsilon, unit::turn);
}

/// A shorter tooth meets others farther from the axis than the eccentricity alone says.
TEST(EdgeMeetings, OfAShorterToothAreFartherOut) {
  force::Setup setup = eccentric_ball(4);
  setup.runout = {.radial_offsets = {0.0, -5 * unit::um, -2 * unit::um, -7 * unit::um},
                  .eccentricity = 6 * unit::um,
                  .angle = 0.7};
  const Edges edges(setup);
  double farthest = 0.0;
  for (const double s : edges.meetings[3]) {
    farthest = std::max(farthest, edges.point(s).meridian.r);
  }
  EXPECT_GT(farthest, 9 * unit::um);
  EXPECT_LT(farthest, 16 * unit::um);
}

TEST(EdgeMeetings, AreWhereTwoTeethStandOnOneRay) {
  const Edges edges(eccentric_ball(5));
  std::size_t found = 0;
  for (std::size_t j = 0; j < edges.psi.size(); ++j) {
    for (const double s : edges.meetings[j]) {
      double nearest = 1.0;
      for (std::size_t k = 0; k < edges.psi.size(); ++k) {
        if (k != j) nearest = std::min(nearest, std::abs(ahead(edges, s, j, k)));
      }
      EXPECT_LT(nearest, 1e-9) << j << " at " << s;
      ++found;
    }
  }
  // The same counted plainly, on equal steps.
  constexpr int steps = 20000;
  const double end = 60 * unit::um;
  std::size_t counted = 0;
  for (std::size_t j = 0; j < edges.psi.size(); ++j) {
    for (std::size_t k = 0; k < edges.psi.size(); ++k) {
      for (int i = 1; k != j && i < steps; ++i) {
        const double a = ahead(edges, end * i / steps, j, k);
        const double b = ahead(edges, end * (i + 1) / steps, j, k);
        counted += (a < 0) != (b < 0) && std::abs(a - b) < 1 ? 1U : 0U;
      }
    }
  }
  EXPECT_GE(counted, 4U);
  EXPECT_EQ(found, counted);
}

TEST(EdgeMeetings, AreNoneWhereChipsDoNotKnowOfThem) {
  const auto none = [](const force::Setup& setup) {
    const Edges edges(setup);
    return std::ranges::all_of(edges.meetings, [](const auto& m) { return m.empty(); });
  };
  EXPECT_FALSE(none(eccentric_ball(3)));
  force::Setup setup = eccentric_ball(3);
  setup.chip.model = chip::Model::radial;
  EXPECT_TRUE(none(setup));
  setup = eccentric_ball(3);
  setup.runout.eccentricity = 0;
  EXPECT_TRUE(none(setup));
  setup = eccentric_ball(3);
  setup.cutter.profile = geometry::cylinder(10 * unit::mm);
  EXPECT_TRUE(none(setup));
  EXPECT_TRUE(none(eccentric_ball(1)));
}

}  // namespace trochoid::force::edge_meetings_test
