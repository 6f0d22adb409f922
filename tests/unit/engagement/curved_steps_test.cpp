#include "made_program.h"

#include <trochoid/force/forces.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace trochoid::engagement::curved_steps_test {

using std::numbers::pi;

const stock::Initial block = box({-20, -20, -10}, {20, 20, 0});

Tool cutter(const geometry::Profile& profile, int teeth, double helix_deg,
            std::vector<double> offsets_um = {}) {
  Tool tool = end_mill(profile.D / unit::mm, teeth, helix_deg, offsets_um);
  tool.cutter.profile = profile;
  tool.gauge_length = 40e-3;
  return tool;
}

/// Along x in the middle of the block.
MadeProgram slot(double depth) {
  MadeProgram made(6000, 600);
  made.rapid(-30, 0, 5).rapid(-30, 0, -depth).line(30, 0, -depth);
  return made;
}

TEST(CurvedSteps, AFullSlotIsThatOfTheForceModel) {  // [N-7] [N-8]
  struct Kind {
    const char* name;
    Tool tool;
  };
  const std::vector<Kind> kinds{
      {"ball", cutter(geometry::ball(6e-3), 2, 30, {0, -8})},
      {"bull nose", cutter(geometry::bull_nose(10e-3, 1.5e-3), 3, 20, {4, -3, -1})},
      {"taper", cutter(geometry::taper(8e-3, 0.15, 0.5e-3), 4, 35)}};
  for (const Kind& kind : kinds) {
    const Step step = at(slot(2), kind.tool, block, 3, 0.5);
    const force::Setup setup{
        .cutter = kind.tool.cutter,
        .runout = kind.tool.runout,
        .cut = {.engagement = geometry::Slot{}, .a_p = 2e-3, .f_z = step.f_z}};
    const auto mean = force::exact_mean(setup, kind.tool.law, 1e-4);
    std::vector<double> phi;
    for (int i = 0; i < 180; ++i) phi.push_back(2 * pi * i / 180);
    double peak = 0.0;
    for (const auto& F : force::forces(setup, kind.tool.law, phi, 1e-4)) {
      peak = std::max(peak, std::hypot(F[0], F[1]));
    }
    EXPECT_NEAR(step.forces.peak_xy, peak, 0.015 * peak) << kind.name;
    EXPECT_NEAR(step.forces.torque_mean, mean.torque, 0.015 * mean.torque) << kind.name;
    for (std::size_t q = 0; q < 3; ++q) {
      EXPECT_NEAR(step.forces.mean[q], mean.force[q], 0.015 * peak) << kind.name << q;
    }
    EXPECT_NEAR(step.a_p, 2e-3, 1e-9) << kind.name;
  }
}

TEST(CurvedSteps, WhatStepsRemoveIsMissingInTheStock) {  // [N-9] [N-17]
  MadeProgram made(6000, 600);
  made.rapid(-15, -4, 5).line(-15, -4, -1).line(15, -4, -1).line(15, -2, -1.5);
  made.line(-15, -2, -1.2).line(-15, 0, -1).line(15, 0, -2).arc(15, 3, 180, -2);
  const Course course = run(made, cutter(geometry::ball(6e-3), 2, 30), block);
  const Totals& all = course.summary.totals;
  EXPECT_NEAR(all.removed, all.stock_before - all.stock_after, 0.03 * all.removed);
  EXPECT_GT(all.removed, 100e-9);
}

TEST(CurvedSteps, ASecondPassOnTheSameLineCutsNothing) {  // [N-3]
  MadeProgram made = slot(1);
  made.line(-30, 0, -1);
  const Tool tool = cutter(geometry::ball(6e-3), 2, 30);
  EXPECT_GT(at(made, tool, block, 3, 0.5).forces.peak_xy, 10.0);
  EXPECT_EQ(at(made, tool, block, 4, 0.5).forces.peak_xy, 0.0);
}

TEST(CurvedSteps, ACutterThatFallsIsPushedUp) {  // [N-18]
  MadeProgram made(6000, 60);
  made.rapid(0, 0, 5).line(0, 0, -2);
  const Step step = at(made, cutter(geometry::ball(6e-3), 2, 30), block, 2, 0.95);
  EXPECT_EQ(step.cause, Cause::plunge);
  EXPECT_GT(step.forces.mean[2], 10.0);
  // Over a turn no side is preferred.
  EXPECT_NEAR(step.forces.mean[0], 0.0, 0.02 * step.forces.mean[2]);
  EXPECT_NEAR(step.forces.mean[1], 0.0, 0.02 * step.forces.mean[2]);
  const double disc = pi * (9e-6 - 1.35e-3 * 1.35e-3);  // at 1.65 mm above the tip
  EXPECT_NEAR(step.removal_rate, disc * 1e-3, 0.02 * disc * 1e-3);
}

TEST(CurvedSteps, AtHeightsArcsAreThoseOfTheCircleThere) {  // [N-3]
  // The second line of a raster at the same depth meets the ridge between the two.
  MadeProgram made(6000, 600);
  made.rapid(-30, 0, 5).rapid(-30, 0, -0.5).line(30, 0, -0.5);
  made.rapid(30, 0.6, -0.5).line(-30, 0.6, -0.5);
  const Tool tool = cutter(geometry::ball(6e-3), 2, 0);
  const std::vector<double> heights{0.02e-3, 0.1e-3};
  const Step step = at(made, tool, block, 5, 0.5, heights);
  ASSERT_EQ(step.layers.size(), 2u);
  for (const Layer& layer : step.layers) {
    // Left of the feed, which goes to -x, is -y: the first line. Stock is where its axis
    // is farther than the radius: 0.6 mm - r cos(theta) > r.
    const double r = std::sqrt(layer.from * (6e-3 - layer.from));
    const double edge = std::acos((0.6e-3 - r) / r);
    ASSERT_EQ(layer.arcs.size(), 1u) << layer.from;
    EXPECT_NEAR(layer.arcs[0].from, edge, 1e-9) << layer.from;
    EXPECT_GT(layer.arcs[0].to, pi);
  }
}

}  // namespace trochoid::engagement::curved_steps_test
