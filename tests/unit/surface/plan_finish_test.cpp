#include <trochoid/base/units.h>
#include <trochoid/surface/plan_finish.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace trochoid::surface {
namespace {

constexpr double mm = 1e-3;
constexpr double um = 1e-6;

/// Round inserts whose arcs alone write the floor.
force::Setup round_inserts() {
  force::Setup setup;
  setup.cutter.profile = geometry::bull_nose(50 * mm, 8 * mm);
  setup.cutter.pitch = geometry::equal_pitch(4);
  setup.cutter.lag_diameter = 50 * mm;
  setup.cut = {
      .engagement = geometry::Slot{}, .a_p = 1 * mm, .f_z = 0.2 * mm, .Omega = 90};
  return setup;
}

FinishPlan asked(double limit) {
  const BottomEdge bottom{
      .dish = 3 * unit::deg, .wiper = 0.0, .lead = 0.03 * unit::deg};
  FinishPlan plan{.lines = {FloorTrace{bottom, 0.0}},
                  .cutoff = {},
                  .feeds = {},
                  .within = 5 * um,
                  .limit = limit};
  for (int i = 1; i <= 12; ++i) plan.feeds.push_back(0.05 * mm * i);
  return plan;
}

/// Ra of arcs of a radius.
double Ra_of_arcs(double f) {
  return f * f / (18 * std::sqrt(3.0) * 8 * mm);
}

TEST(PlanFinish, OfTeethAtOneDepthIsThatOfArcs) {  // [W-1] [W-9]
  const PlannedFinish plan = plan_finish(round_inserts(), asked(0.5 * um));
  for (const FinishOfFeed& f : plan.feeds) {
    ASSERT_TRUE(f.Ra.alike && f.Ra.as_is);
    EXPECT_NEAR(*f.Ra.alike, Ra_of_arcs(f.f_z), 0.01 * Ra_of_arcs(f.f_z)) << f.f_z;
    EXPECT_NEAR(*f.Ra.as_is, *f.Ra.alike, 0.01 * *f.Ra.alike);
  }
  const double f = std::sqrt(0.5 * um * 18 * std::sqrt(3.0) * 8 * mm);
  ASSERT_TRUE(plan.largest.alike);
  EXPECT_NEAR(*plan.largest.alike, f, 0.01 * f);
}

TEST(PlanFinish, KeepsASmallerFeedWithAToothThatStandsOut) {  // [W-9]
  force::Setup setup = round_inserts();
  setup.runout.axial_offsets = {0.0, 30 * um, 0.0, 0.0};  // it writes everything
  FinishPlan of = asked(0.5 * um);
  of.within = 0.3 * um;
  const PlannedFinish plan = plan_finish(setup, of);
  const double alone = std::sqrt(0.5 * um * 18 * std::sqrt(3.0) * 8 * mm) / 4;
  ASSERT_TRUE(plan.largest.as_is && plan.largest.within && plan.largest.alike);
  EXPECT_NEAR(*plan.largest.as_is, alone, 0.01 * alone);
  EXPECT_GT(*plan.largest.within, *plan.largest.as_is);
  EXPECT_GT(*plan.largest.alike, *plan.largest.within);
}

TEST(PlanFinish, IsKeptByNineteenOfTwentySets) {  // [W-9]
  const FinishPlan plan = asked(0.5 * um);
  const PlannedFinish found = plan_finish(round_inserts(), plan);
  const FinishOfFeed& at = found.feeds[3];
  std::mt19937 random(5);
  std::uniform_real_distribution<double> offset(0.0, plan.within);
  int below = 0;
  for (int i = 0; i < 200; ++i) {
    force::Setup setup = round_inserts();
    setup.cut.f_z = at.f_z;
    for (int j = 0; j < 4; ++j) setup.runout.axial_offsets.push_back(offset(random));
    const auto& line = std::get<FloorTrace>(plan.lines.front());
    const double Ra = roughness(floor_profile(setup, line.bottom, line.y)).Ra;
    below += Ra <= *at.Ra.within ? 1 : 0;
  }
  EXPECT_GE(below, 180);
  EXPECT_LE(below, 198);
}

TEST(PlanFinish, NamesNoFeedWhereNoneKeepsTheLimit) {
  const PlannedFinish plan = plan_finish(round_inserts(), asked(0.001 * um));
  EXPECT_FALSE(plan.largest.as_is);
  EXPECT_FALSE(plan.largest.alike);
}

}  // namespace
}  // namespace trochoid::surface
