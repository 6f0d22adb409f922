#include <trochoid/engagement/chatter.h>

#include <trochoid/dynamics/lobes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "made_program.h"

namespace trochoid::engagement::chatter_test {

const stock::Initial block = box({-40, -40, -10}, {40, 40, 0});

dynamics::ChipMode mode(double x, double y, double mass = 0.2) {
  const double omega = 2 * std::numbers::pi * 900;
  return {mass, 2 * 0.03 * omega * mass, mass * omega * omega, x, y};
}

/// The limits of the cuts of a program, with the cut that takes longest first.
struct Found {
  std::vector<SharedCut> cuts;
  std::vector<ChatterLimit> limits;
  std::vector<std::int32_t> which;
  std::size_t longest = 0;
};

Found limits_of(const MadeProgram& made, const Tool& tool, const Vibration& vibration) {
  const Job job{made.program, std::span(&tool, 1), block, {}};
  SharedCuts cuts(job.tools, std::span(&vibration, 1));
  Found out;
  compute_steps(job, [&](std::span<const Step> rows) { cuts.add(rows, out.which); });
  out.cuts = cuts.all();
  out.limits = chatter_limits(out.cuts, job.tools, std::span(&vibration, 1));
  for (std::size_t k = 0; k < out.cuts.size(); ++k) {
    if (out.cuts[k].duration > out.cuts[out.longest].duration) out.longest = k;
  }
  return out;
}

/// The first depth at which a straight cut chatters.
dynamics::Limit straight_limit(const Tool& tool, const geometry::Engagement& engagement,
                               const dynamics::ChipMode& mode, double spindle) {
  force::Setup setup{.cutter = tool.cutter,
                     .runout = tool.runout,
                     .cut = {engagement, 2e-3, 0.05e-3, spindle},
                     .chip = tool.chip};
  std::vector<double> depths;
  for (int i = 1; i <= 40; ++i) depths.push_back(0.25e-3 * i);
  const dynamics::DirectionalModel model(setup, tool.law, 2e-6, 1e-8);
  return *dynamics::limit_depth(model, {{mode}}, spindle, depths, 1e-4);
}

/// 4 mm of a wall are milled down, along +x or along +y.
MadeProgram wall(double rpm, bool along_y = false) {
  MadeProgram made(rpm, 0.15 * rpm);
  return along_y ? made.rapid(-41, -50, 5).rapid(-41, -50, -2).line(-41, 50, -2)
                 : made.rapid(-50, 41, 5).rapid(-50, 41, -2).line(50, 41, -2);
}

constexpr double slow = 4000 * unit::rpm;
const geometry::Engagement side = geometry::DownMilling{4e-3};

TEST(ChatterLimits, TheCutThatMostOfTheTimeHasStandsForOthers) {
  // At the entry the arc ends before 180 degrees.
  const Tool tool = end_mill(10, 3, 30);
  const Found found = limits_of(wall(4000), tool, {{{mode(0, 1)}}, 2e-6});
  EXPECT_NEAR(found.cuts[found.longest].layers[0].arcs[0].to, std::numbers::pi, 1e-6);
}

TEST(ChatterLimits, StockAboveTheTipCountsByItsHeight) {
  const Tool tool = end_mill(10, 3, 30);
  const Vibration vibration{{{mode(0, 1)}}, 2e-6};
  const auto lower = [](double z) {
    return MadeProgram(4000, 600).rapid(-50, 41, 5).rapid(-50, 41, z).line(50, 41, z);
  };
  const stock::Initial plate = box({-40, -40, -2}, {40, 40, 0});
  std::vector<double> depths;
  for (const double z : {-2.0, -6.0}) {
    const MadeProgram made = lower(z);
    const Job job{made.program, std::span(&tool, 1), plate, {}};
    SharedCuts cuts(job.tools, std::span(&vibration, 1));
    std::vector<std::int32_t> which;
    compute_steps(job, [&](std::span<const Step> rows) { cuts.add(rows, which); });
    const auto limits = chatter_limits(cuts.all(), job.tools, std::span(&vibration, 1));
    const auto longest =
        std::ranges::max_element(cuts.all(), {}, &SharedCut::duration) -
        cuts.all().begin();
    const ChatterLimit& limit = limits[static_cast<std::size_t>(longest)];
    ASSERT_TRUE(limit.depth);
    EXPECT_NEAR(limit.margin, *limit.depth / 2e-3, 1e-6);
    depths.push_back(*limit.depth);
  }
  EXPECT_NEAR(depths[1], depths[0], 0.02 * depths[0]);
}

TEST(ChatterLimits, OfAStraightWallAreThoseOfThatCut) {  // [N-19]
  for (const bool even : {true, false}) {
    const Tool tool = even ? end_mill(10, 3, 30) : end_mill(10, 3, 30, {8, 0, -5});
    const Found found = limits_of(wall(4000), tool, {{{mode(0, 1)}}, 2e-6});
    const SharedCut& cut = found.cuts[found.longest];
    const ChatterLimit& limit = found.limits[found.longest];
    EXPECT_NEAR(cut.a_p, 2e-3, 1e-9);
    ASSERT_TRUE(limit.known && limit.depth);
    const dynamics::Limit alone = straight_limit(tool, side, mode(0, 1), slow);
    EXPECT_NEAR(*limit.depth, alone.depth, 0.02 * alone.depth) << even;
    EXPECT_GT(limit.frequency, 800);
    EXPECT_LT(limit.frequency, 1100);
  }
}

TEST(ChatterLimits, TurnWithTheFeed) {  // [N-19]
  const Tool tool = end_mill(10, 3, 30);
  const auto depth = [&](bool along_y, const dynamics::ChipMode& m) {
    const Found found = limits_of(wall(4000, along_y), tool, {{{m}}, 2e-6});
    return found.limits[found.longest].depth.value_or(1.0);
  };
  const double across = depth(false, mode(0, 1));
  EXPECT_NEAR(depth(true, mode(1, 0)), across, 1e-3 * across);
  EXPECT_GT(std::abs(depth(true, mode(0, 1)) - across), 0.2 * across);
}

TEST(ChatterLimits, OfASlotAcrossTheAxes) {  // [N-19]
  const Tool tool = end_mill(10, 3, 30);
  const double c = std::cos(60 * unit::deg);
  const double s = std::sin(60 * unit::deg);
  MadeProgram made(4000, 600);
  made.rapid(-60 * c, -60 * s, 5).rapid(-60 * c, -60 * s, -2).line(60 * c, 60 * s, -2);
  const Found found = limits_of(made, tool, {{{mode(1, 0)}}, 2e-6});
  const double depth = found.limits[found.longest].depth.value_or(1.0);
  const auto alone = [&](double across) {
    return straight_limit(tool, geometry::Slot{}, mode(c, across), slow).depth;
  };
  EXPECT_NEAR(depth, alone(-s), 0.015 * depth);
  EXPECT_GT(std::abs(depth - alone(s)), 0.03 * depth);
}

TEST(ChatterLimits, NameASpeedAtWhichTheCutIsStable) {
  const Tool tool = end_mill(10, 3, 30);
  const dynamics::ChipMode stiff = mode(0, 1, 0.9);
  int named = 0;
  for (const double rpm : {4000.0, 5000.0, 6400.0, 7600.0}) {
    const Found found = limits_of(wall(rpm), tool, {{{stiff}}, 2e-6});
    const ChatterLimit& limit = found.limits[found.longest];
    ASSERT_TRUE(limit.known);
    const bool chatters = limit.depth && *limit.depth < 2e-3;
    if (!limit.better_spindle) continue;
    EXPECT_TRUE(chatters);
    ++named;
    EXPECT_GT(straight_limit(tool, side, stiff, *limit.better_spindle).depth, 2e-3);
  }
  EXPECT_GT(named, 1);
}

TEST(SharedCuts, AreFewAlongAStraightLine) {
  const Found found =
      limits_of(wall(4000), end_mill(10, 3, 30), {{{mode(0, 1)}}, 2e-6});
  EXPECT_LT(found.cuts.size(), 80U);   // entry, the line, exit
  EXPECT_EQ(found.which.front(), -1);  // in air
  double duration = 0.0;
  for (const SharedCut& cut : found.cuts) duration += cut.duration;
  EXPECT_GT(found.cuts[found.longest].duration, 0.8 * duration);
}

TEST(SharedCuts, AreNoneOfAToolWithoutModes) {
  const Found found = limits_of(wall(4000), end_mill(10, 3, 30), {});
  EXPECT_TRUE(found.cuts.empty());
  EXPECT_EQ(std::ranges::count(found.which, -1),
            static_cast<std::ptrdiff_t>(found.which.size()));
}

}  // namespace trochoid::engagement::chatter_test
