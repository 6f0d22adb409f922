#include "made_wall.h"

#include <trochoid/surface/pass_sequence.h>

#include <gtest/gtest.h>

#include <stdexcept>

namespace trochoid::surface::pass_sequence_test {

constexpr Coefficients K = {800e6, 300e6, 0, 0};
const structure::Plate plate{60e-3, 30e-3, 4e-3, 69e9, 0.33};

Setting cutting(bool down = true, Model model = Model::envelope) {
  Setting s = made_setting(model, made_cut(down), cutter_only());
  s.law = law(K[0], K[1], K[2], K[3]);
  return s;
}

MapOptions coarse() {
  return {
      .samples_per_turn = 30, .heights = {0.3e-3, 1.5e-3, 2.7e-3}, .position = 30e-3};
}

TEST(StockLeft, AnEvenOneIsADeeperCut) {  // [E-40]
  for (const bool down : {true, false}) {
    const MadeCut s = made_cut(down);
    MadeCut deeper = s;
    if (down) {
      deeper.cut.engagement = geometry::DownMilling{1.2e-3};
    } else {
      deeper.cut.engagement = geometry::UpMilling{1.2e-3};
    }
    const numerics::LagrangeBasis basis(0.0, s.cut.a_p, 16);
    const force::Law some = law(K[0], K[1], 9e3, 4e3);
    const EdgeMoments left(s, some, basis, [](double) { return 0.2e-3; });
    const EdgeMoments whole(deeper, some, basis);
    std::vector<double> a(columns * left.values());
    std::vector<double> b(a.size());
    for (const double phi : angles(11)) {
      left.at(phi, nullptr, a);
      whole.at(phi, nullptr, b);
      for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_NEAR(a[i], b[i], 1e-12);
      }
    }
    const auto kinks = left.kinks(false);
    const auto wanted = whole.kinks(false);
    ASSERT_EQ(kinks.size(), wanted.size());
    for (std::size_t i = 0; i < kinks.size(); ++i) {
      EXPECT_NEAR(kinks[i], wanted[i], 1e-9);
    }
  }
}

TEST(StockLeft, AddsToTheShiftOfABentCutter) {  // [E-40] [E-10]
  const MadeCut s = made_cut();
  const numerics::LagrangeBasis basis(0.0, s.cut.a_p, 16);
  const EdgeMoments left(s, law(K[0], K[1]), basis, [](double) { return 0.2e-3; });
  const EdgeMoments plain(s, law(K[0], K[1]), basis);
  force::Bend bend;
  bend.shift = [](double) { return 0.15e-3; };
  force::Bend both;
  both.shift = [](double) { return -0.05e-3; };  // 0.15 away, 0.2 more stock
  std::vector<double> a(columns * left.values());
  std::vector<double> b(a.size());
  for (const double phi : angles(7)) {
    left.at(phi, &bend, a);
    plain.at(phi, &both, b);
    EXPECT_EQ(a, b);
  }
}

TEST(StockLeft, NeedsASingleWall) {
  MadeCut slot = made_cut();
  slot.cut.engagement = geometry::Slot{};
  const numerics::LagrangeBasis basis(0.0, slot.cut.a_p, 16);
  EXPECT_THROW(EdgeMoments(slot, law(1, 1), basis, [](double) { return 0.0; }),
               std::invalid_argument);
}

TEST(PassSequence, OnePassIsTheCutItself) {  // [E-41]
  const Setting s = cutting();
  const PassCut one[] = {{1e-3, 0.2e-3}};
  const PassSequence all = pass_sequence(s, coarse(), one, {.cutter = made_cutter()});
  const ErrorMap map = error_map(s, coarse());
  ASSERT_EQ(all.passes.size(), 1U);
  ASSERT_EQ(all.map.rows.size(), map.rows.size());
  for (std::size_t i = 0; i < map.rows.size(); ++i) {
    EXPECT_EQ(all.map.rows[i].error, map.rows[i].error);
  }
  EXPECT_EQ(all.map.error.mean, map.error.mean);
  EXPECT_EQ(all.passes[0].error.max, map.error.max);
  EXPECT_EQ(all.passes[0].radial_depth.max, 1e-3);
  EXPECT_EQ(all.map.influence_heights, coarse().heights);
}

TEST(PassSequence, WhatIsLeftIsStockOfTheNextPass) {  // [E-40] [E-41]
  const PassCut two[] = {{1e-3, 0.2e-3}, {0.5e-3, 0.1e-3}};
  const PassSequence all =
      pass_sequence(cutting(), coarse(), two, {.cutter = made_cutter()});
  ASSERT_EQ(all.passes.size(), 2U);
  const PassOutcome& second = all.passes[1];
  EXPECT_GT(second.radial_depth.max, 0.5e-3 + 20e-6);
  // By hand: the mean errors at a few heights, straight between them.
  Setting next = cutting();
  next.setup.cut.f_z = 0.1e-3;
  next.setup.cut.engagement = geometry::DownMilling{0.5e-3};
  MapOptions fine = coarse();
  fine.heights.clear();
  for (int i = 0; i <= 60; ++i) fine.heights.push_back(std::min(3e-3, 3e-3 * i / 60));
  const ErrorMap first = error_map(cutting(), fine);
  next.left = [&](double z) {
    const double at = std::clamp(60 * z / 3e-3, 0.0, 59.999);
    const auto i = static_cast<std::size_t>(at);
    const double part = at - static_cast<double>(i);
    return (1 - part) * first.rows[i].statistics.error.mean +
           part * first.rows[i + 1].statistics.error.mean;
  };
  const ErrorMap by_hand = error_map(next, coarse());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(all.map.rows[i].statistics.error.mean,
                by_hand.rows[i].statistics.error.mean, 0.02e-6);
  }
  EXPECT_NEAR(all.map.F_normal.max, by_hand.F_normal.max, 2e-3 * by_hand.F_normal.max);
}

TEST(PassSequence, ASpringPassTakesSomeOfItAndAddsNothing) {  // [E-41]
  for (const bool down : {true, false}) {
    const PassCut three[] = {{1e-3, 0.2e-3}, {0.0, 0.2e-3}, {0.0, 0.2e-3}};
    const PassSequence all =
        pass_sequence(cutting(down), coarse(), three, {.cutter = made_cutter()});
    ASSERT_EQ(all.passes.size(), 3U);
    for (std::size_t k = 1; k < 3; ++k) {
      EXPECT_LT(std::abs(all.passes[k].error.mean),
                std::abs(all.passes[k - 1].error.mean) + 1e-9);
      EXPECT_LE(all.passes[k].error.max, all.passes[k].radial_depth.max + 1e-9);
    }
    EXPECT_LT(all.passes[1].F_normal.max, 0.5 * all.passes[0].F_normal.max);
  }
}

TEST(PassSequence, NothingGrowsBack) {  // [E-41]
  // What stands 5 um below the wall that the teeth would leave stays there, uncut.
  Setting s = cutting();
  s.setup.cut.engagement = geometry::DownMilling{1e-6};
  s.left = [](double) { return -6e-6; };
  const ErrorMap map = error_map(s, coarse());
  for (const ErrorRow& row : map.rows) {
    for (std::size_t i = 0; i < row.error.size(); ++i) {
      EXPECT_NEAR(row.error[i], -5e-6, 1e-15);
      EXPECT_EQ(row.tooth[i], -1);
    }
    EXPECT_EQ(row.statistics.share, (std::vector<double>{0, 0, 0}));
  }
}

TEST(PassSequence, TheWallThinsWhereItIsCut) {  // [E-41] [B-9]
  const PassCut two[] = {{1e-3, 0.2e-3}, {1e-3, 0.2e-3}};
  const PassSequence all =
      pass_sequence(cutting(), coarse(), two, {.cutter = made_cutter(), .wall = plate});
  const PassOutcome& first = all.passes[0];
  const PassOutcome& second = all.passes[1];
  EXPECT_EQ(first.thickness_before, 4e-3);
  EXPECT_EQ(second.thickness_before, first.thickness_after);
  EXPECT_NEAR(first.thickness_after, 3e-3 + first.error.mean, 3e-6);
  EXPECT_NEAR(second.thickness_after, 2e-3 + second.error.mean, 3e-6);
  // The second pass meets a wall that is thinner above its tip and thick below.
  structure::Plate stepped = plate;
  stepped.layers = {{27e-3, second.thickness_before}};
  const std::vector<double> edge = {30e-3};
  const double G = structure::PlateSolution(stepped, 30e-3, 2e-4, 3e-3)
                       .influence(30e-3, edge, 30e-3, edge)[0];
  MapOptions top = coarse();
  top.influence_heights = {3e-3};
  const PassSequence seen =
      pass_sequence(cutting(), top, two, {.cutter = made_cutter(), .wall = plate});
  EXPECT_NEAR(seen.map.influence_of_wall[0] / G, 1, 1e-9);
}

TEST(PassSequence, OfFullDepthThinsTheWholeWall) {  // [E-41]
  structure::Plate low = plate;
  low.height = 3e-3;
  low.thickness = 0.8e-3;
  const PassCut two[] = {{0.1e-3, 0.05e-3}, {0.1e-3, 0.05e-3}};
  MapOptions top = coarse();
  top.influence_heights = {3e-3};
  const PassSequence all = pass_sequence(cutting(), top, two, {.wall = low});
  low.thickness = all.passes[1].thickness_before;
  const std::vector<double> edge = {3e-3};
  const double G = structure::PlateSolution(low, 30e-3, 2e-4, 3e-3)
                       .influence(30e-3, edge, 30e-3, edge)[0];
  EXPECT_NEAR(all.map.influence_of_wall[0] / G, 1, 1e-9);
}

TEST(PassSequence, StepsDownTheWall) {  // [E-41] [B-9]
  MapOptions top = coarse();
  top.influence_heights = {3e-3};
  const auto G = [](const structure::Plate& wall, double y) {
    const std::vector<double> at = {y};
    return structure::PlateSolution(wall, 30e-3, 2e-4, 12e-3)
        .influence(30e-3, at, 30e-3, at)[0];
  };
  const auto run = [&](std::vector<PassCut> cuts) {
    return pass_sequence(cutting(), top, cuts,
                         {.cutter = made_cutter(), .wall = plate});
  };
  const PassCut first{1e-3, 0.2e-3};
  const PassCut lower{1e-3, 0.2e-3, 3e-3};
  const PassCut lowest{1e-3, 0.2e-3, 9e-3};
  // A lower level has nothing left before it, on a wall that is thin above.
  const PassSequence two = run({first, lower});
  EXPECT_EQ(two.passes[1].radial_depth.max, 1e-3);
  EXPECT_EQ(two.passes[1].thickness_before, 4e-3);
  structure::Plate stepped = plate;
  stepped.layers = {{27e-3, two.passes[0].thickness_after}};
  EXPECT_NEAR(two.map.influence_of_wall[0] / G(stepped, 27e-3), 1, 1e-3);
  // Back at the first level: both are thin.
  const PassSequence back = run({first, lower, first});
  EXPECT_EQ(back.passes[2].thickness_before, back.passes[0].thickness_after);
  EXPECT_GT(back.passes[2].radial_depth.max, 1e-3);
  stepped.layers = {{24e-3, back.passes[1].thickness_after},
                    {27e-3, back.passes[0].thickness_after}};
  EXPECT_NEAR(back.map.influence_of_wall[0] / G(stepped, 30e-3), 1, 1e-3);
  // Whole again between two levels that do not touch, and above one that is alone.
  const PassSequence apart = run({first, lowest, lower});
  stepped.layers = {{18e-3, apart.passes[1].thickness_after},
                    {21e-3, 4e-3},
                    {27e-3, apart.passes[0].thickness_after}};
  EXPECT_NEAR(apart.map.influence_of_wall[0] / G(stepped, 27e-3), 1, 1e-3);
  const PassSequence alone = run({lowest, first});
  stepped.layers = {{18e-3, alone.passes[0].thickness_after}, {21e-3, 4e-3}};
  EXPECT_NEAR(alone.map.influence_of_wall[0] / G(stepped, 30e-3), 1, 1e-3);
  EXPECT_THROW(run({first, {1e-3, 0.2e-3, 2e-3}}), std::invalid_argument);
}

TEST(PassSequence, StopsAtThePassWithoutASteadyState) {  // [E-41]
  structure::Cantilever soft = made_cutter();
  soft.youngs_modulus /= 1000;
  MapOptions options = coarse();
  options.feedback = Feedback::entry;
  const PassCut two[] = {{1e-3, 0.2e-3}, {1e-3, 0.2e-3}};
  const PassSequence all =
      pass_sequence(cutting(false), options, two, {.cutter = soft});
  EXPECT_FALSE(all.map.converged);
  EXPECT_TRUE(all.passes.empty());
}

TEST(PassSequence, APulseIsNoSurface) {
  const PassCut one[] = {{1e-3, 0.2e-3}};
  EXPECT_THROW(pass_sequence(cutting(true, Model::quasi_static), coarse(), one, {}),
               std::invalid_argument);
}

}  // namespace trochoid::surface::pass_sequence_test
