#include "made_program.h"

#include <trochoid/force/forces.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/stock/path.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace trochoid::engagement::steps_test {

using std::numbers::pi;

const stock::Initial block = box({-40, -40, -10}, {40, 40, 0});

/// Across the block at y, 2 mm deep, on the side of the stock.
MadeProgram side_pass(double y) {
  MadeProgram made(1000, 100);
  made.rapid(-50, y, 5).rapid(-50, y, -2).line(50, y, -2);
  return made;
}

TEST(Steps, TheArcOfASidePassIsThatOfItsRadialDepth) {  // [N-3]
  const Tool tool = end_mill(10, 2, 30);
  const Step up = at(side_pass(-43), tool, block, 3, 0.5);
  ASSERT_EQ(up.layers.size(), 1u);
  EXPECT_NEAR(up.entry, 0.0, 1e-12);
  EXPECT_NEAR(up.exit, std::acos(1 - 2.0 / 5), 1e-12);
  EXPECT_NEAR(up.a_p, 2e-3, 1e-12);
  EXPECT_NEAR(up.a_e, 2e-3, 1e-12);
  EXPECT_EQ(up.cause, Cause::side);
  const Step down = at(side_pass(43), tool, block, 3, 0.5);
  EXPECT_NEAR(down.entry, pi - std::acos(1 - 2.0 / 5), 1e-12);
  EXPECT_NEAR(down.exit, pi, 1e-12);
  EXPECT_NEAR(down.f_z, 0.05e-3, 1e-15);
}

TEST(Steps, ForcesOfASidePassAreThoseOfDownMilling) {  // [N-7] [N-8] [N-10]
  Tool tool = end_mill(10, 3, 30, {4, -3, -1});
  tool.gauge_length = 40e-3;
  const Step step = at(side_pass(43), tool, block, 3, 0.5);
  force::Setup setup{
      .cutter = tool.cutter,
      .runout = tool.runout,
      .cut = {.engagement = geometry::DownMilling{2e-3}, .a_p = 2e-3, .f_z = step.f_z}};
  std::vector<double> phi;
  for (int i = 0; i < 3600; ++i) phi.push_back(2 * pi * i / 3600);
  double peak = 0.0;
  std::array<double, 2> most{};
  for (const auto& F : force::forces(setup, tool.law, phi, 1e-9)) {
    peak = std::max(peak, std::hypot(F[0], F[1]));
    for (std::size_t q = 0; q < 2; ++q) {
      if (std::abs(F[q]) > std::abs(most[q])) most[q] = F[q];
    }
  }
  // Own walls end its arcs at pi; the exact chip goes on by half a feed.
  EXPECT_NEAR(step.forces.peak_xy, peak, 1e-3 * peak);
  EXPECT_NEAR(step.forces.peak[0], most[0], 1e-3 * peak);
  EXPECT_NEAR(step.forces.peak[1], most[1], 1e-3 * peak);
  const auto mean = *force::mean_force(setup, tool.law, 1e-9);
  for (std::size_t q = 0; q < 3; ++q) {
    EXPECT_NEAR(step.forces.mean[q], mean[q], 2e-3 * std::abs(mean[1]));
  }
  EXPECT_NEAR(step.forces.power, step.forces.torque_mean * 1000 * unit::rpm, 1e-9);
}

TEST(Steps, AToothWithoutLagIsLargestJustBeforeItLeaves) {  // [N-7]
  const Tool tool = end_mill(10, 2, 0, {0, -8});
  const Step step = at(side_pass(-43), tool, block, 3, 0.5);
  const force::Setup setup{
      .cutter = tool.cutter,
      .runout = tool.runout,
      .cut = {.engagement = geometry::UpMilling{2e-3}, .a_p = 2e-3, .f_z = step.f_z}};
  std::vector<double> phi;
  for (int i = 0; i < 100000; ++i) phi.push_back(2 * pi * i / 100000);
  std::array<double, 2> most{};  // one tooth at a time is in cut
  for (std::size_t i = 0; const auto& F : force::forces(setup, tool.law, phi, 1e-9)) {
    const std::size_t tooth = phi[i++] < pi ? 0 : 1;
    most[tooth] = std::max(most[tooth], std::hypot(F[0], F[1]));
  }
  EXPECT_NEAR(step.forces.peak_of_tooth[0], most[0], 1e-3 * most[0]);
  EXPECT_NEAR(step.forces.peak_of_tooth[1], most[1], 1e-3 * most[1]);
}

// The edge covers the same windows of theta, whichever way it winds.
TEST(Steps, ALeftHandHelixHasThePeaksOfARightHandOne) {  // [N-7]
  for (const double helix : {10.0, 30.0, 45.0}) {
    for (const double y : {43.0, 44.7, -42.0}) {
      const TurnForces left =
          at(side_pass(y), end_mill(10, 2, -helix), block, 3, 0.5).forces;
      const TurnForces right =
          at(side_pass(y), end_mill(10, 2, helix), block, 3, 0.5).forces;
      const double most = right.peak_xy;
      EXPECT_NEAR(left.peak_xy, most, 5e-4 * most) << helix << " " << y;
      EXPECT_NEAR(left.torque_peak, right.torque_peak, 5e-4 * right.torque_peak);
      EXPECT_NEAR(left.peak_of_tooth[0], left.peak_of_tooth[1], 5e-4 * most);
      EXPECT_NEAR(left.peak_of_tooth[0], right.peak_of_tooth[0], 5e-4 * most);
    }
  }
}

TEST(Steps, ATurnedPathTurnsItsForces) {  // [N-10]
  const Tool tool = end_mill(10, 2, 30, {0, -8});
  const Step along = at(side_pass(43), tool, block, 3, 0.4);
  MadeProgram made(1000, 100);  // the same cut along +y, stock on the right as before
  made.rapid(-43, -50, 5).rapid(-43, -50, -2).line(-43, 50, -2);
  const Step across = at(made, tool, block, 3, 0.4);
  EXPECT_NEAR(across.direction, pi / 2, 1e-12);
  EXPECT_NEAR(across.forces.mean[0], -along.forces.mean[1], 1e-9);
  EXPECT_NEAR(across.forces.mean[1], along.forces.mean[0], 1e-9);
  EXPECT_NEAR(across.forces.peak[0], -along.forces.peak[1], 1e-6);
  EXPECT_NEAR(across.forces.peak[1], along.forces.peak[0], 1e-6);
}

TEST(Steps, ALineInPiecesGivesTheSameRows) {
  const Tool tool = end_mill(10, 2, 30, {0, -8});
  MadeProgram whole(1000, 100);
  whole.rapid(-50, -41, 5).rapid(-50, -41, -2).line(-30, -21, -2);
  MadeProgram pieces(1000, 100);
  pieces.rapid(-50, -41, 5).rapid(-50, -41, -2);
  for (const double u : {0.013, 0.07, 0.1, 0.34, 0.5, 0.501, 0.7, 0.8, 0.95, 1.0}) {
    pieces.line(-50 + 20 * u, -41 + 20 * u, -2);
  }
  const Course a = run(whole, tool, block);
  const Course b = run(pieces, tool, block);
  EXPECT_EQ(a.summary.totals.steps, b.summary.totals.steps);
  std::vector<Step> cut_a;
  std::vector<Step> cut_b;
  const auto cuts = [](const Step& step) { return step.a_p > 0; };
  std::ranges::copy_if(a.rows, std::back_inserter(cut_a), cuts);
  std::ranges::copy_if(b.rows, std::back_inserter(cut_b), cuts);
  ASSERT_EQ(cut_a.size(), cut_b.size());
  for (std::size_t i = 0; i < cut_a.size(); ++i) {
    EXPECT_EQ(cut_a[i].step, cut_b[i].step);
    EXPECT_NEAR(cut_a[i].engaged, cut_b[i].engaged, 1e-9);
    EXPECT_NEAR(cut_a[i].removed, cut_b[i].removed, 1e-18);
    EXPECT_NEAR(cut_a[i].forces.peak_xy, cut_b[i].forces.peak_xy, 1e-6);
  }
}

TEST(Steps, AMirroredPathGivesMirroredArcs) {
  const Tool tool = end_mill(10, 1, 0);
  MadeProgram made(1000, 100);
  MadeProgram mirrored(1000, 100);
  made.rapid(-50, 0, -2).line(0, 0, -2).arc(0, 6, 70, -2).line(30, 30, -2);
  mirrored.rapid(-50, 0, -2).line(0, 0, -2).arc(0, -6, -70, -2).line(30, -30, -2);
  for (const double u : {0.1, 0.5, 0.93}) {
    for (const std::uint32_t line : {2u, 3u, 4u}) {
      const Step a = at(made, tool, block, line, u);
      const Step b = at(mirrored, tool, block, line, u);
      EXPECT_NEAR(a.engaged, b.engaged, 1e-9);
      if (a.a_p > 0) {
        EXPECT_NEAR(a.entry, pi - b.exit, 1e-9);
      }
      EXPECT_NEAR(a.curvature, -b.curvature, 1e-9);
    }
  }
}

/// What the tool has covered a turn ago, by very many places of its tip.
bool stock_by_sampling(const MadeProgram& made, double R, std::array<double, 3> q,
                       double turns) {
  const stock::Path path = stock::path(made.program.moves, 10.0 / 60);
  if (q[2] > 0) return false;
  for (const stock::Piece& piece : path.pieces) {
    constexpr int n = 40000;
    for (int i = 0; i <= n; ++i) {
      const double u = static_cast<double>(i) / n;
      if (piece.turns_from + u * (piece.turns_to - piece.turns_from) > turns) break;
      const stock::Point tip = stock::point_at(piece, u).place;
      if (tip[2] <= q[2] && std::hypot(tip[0] - q[0], tip[1] - q[1]) < R) return false;
    }
  }
  return true;
}

TEST(Steps, AHelicalBoreMeetsWhatItsOlderTurnsLeft) {  // [N-2] [N-3]
  const Tool tool = end_mill(8, 2, 0);
  MadeProgram made(3000, 300);
  made.rapid(3, 0, 0.5).arc(0, 0, 4 * 360, -2).arc(0, 0, 360, -2);
  const stock::Path path = stock::path(made.program.moves, 10.0 / 60);
  for (const double u : {0.41, 0.83}) {
    const std::vector<double> heights{0.05e-3, 0.3e-3, 0.55e-3};
    const Step step = at(made, tool, block, 2, u, heights);
    ASSERT_EQ(step.layers.size(), heights.size());
    const stock::Piece& piece = path.pieces.front();
    const double turns = piece.turns_from + u * (piece.turns_to - piece.turns_from) - 1;
    for (const Layer& layer : step.layers) {
      int differ = 0;
      for (double theta = 0.013; theta < pi; theta += 0.05) {
        const double angle = step.direction + pi / 2 - theta;
        const std::array<double, 3> q{step.place[0] + 4e-3 * std::cos(angle),
                                      step.place[1] + 4e-3 * std::sin(angle),
                                      step.place[2] + layer.from};
        const bool stock = std::ranges::any_of(layer.arcs, [&](const chip::Arc& arc) {
          return theta > arc.from && theta < arc.to;
        });
        differ += stock != stock_by_sampling(made, 4e-3, q, turns) ? 1 : 0;
      }
      EXPECT_LE(differ, 1) << u << ' ' << layer.from;  // an end may lie between
    }
  }
}

TEST(Steps, WhatStepsRemoveIsWhatTheStockLoses) {  // [N-9]
  const Tool tool = end_mill(6, 2, 30);
  MadeProgram pocket(5000, 400);
  pocket.rapid(0, 0, 1).line(0, 0, -2);
  for (double r = 2; r < 15; r += 2.4) {
    pocket.line(r, -r, -2).line(r, r, -2).line(-r, r, -2).line(-r, -r, -2);
    pocket.line(r, -r, -2);
  }
  MadeProgram ramps(3000, 400);
  ramps.rapid(-30, 0, 0).line(20, 5, -1.5).line(-30, 0, -3).line(20, 5, -3);
  MadeProgram bore(3000, 300);
  bore.rapid(2, 0, 0.2).arc(0, 0, 5 * 360, -3).arc(0, 0, 360, -3);
  for (const MadeProgram& made : {pocket, ramps, bore}) {
    const Totals totals = run(made, tool, block).summary.totals;
    const double difference = totals.stock_before - totals.stock_after;
    EXPECT_GT(difference, 100e-9);
    EXPECT_NEAR(totals.removed, difference, 2e-4 * difference);
  }
}

TEST(Steps, APlungeRemovesItsHoleAndIsEstimated) {  // [N-11]
  const Tool tool = end_mill(8, 2, 30);
  MadeProgram made(3000, 60);
  made.rapid(0, 0, 0.5).line(0, 0, -2);
  const Course found = run(made, tool, block);
  EXPECT_NEAR(found.summary.totals.removed, pi * 16e-6 * 2e-3, 1e-7 * 1e-7);
  const Step step = at(made, tool, block, 2, 0.7);
  EXPECT_EQ(step.cause, Cause::plunge);
  EXPECT_NEAR(step.bottom_force, 2 * (1560e6 * 0.01e-3 + 3e3) * 4e-3, 1e-6);
  EXPECT_NEAR(step.bottom_torque, 2 * (2620e6 * 0.01e-3 + 7e3) * 8e-6, 1e-8);
  EXPECT_EQ(step.forces.peak_xy, 0.0);
  EXPECT_TRUE(step.layers.empty());
  // Over an old hole there is nothing below.
  made.rapid(0, 0, 0.5).line(0, 0, -2);
  EXPECT_EQ(at(made, tool, block, 4, 0.7).bottom_force, 0.0);
}

TEST(Steps, CausesAreToldApart) {
  const Tool tool = end_mill(10, 2, 30);
  MadeProgram made(1000, 100);
  made.rapid(-50, 0, -2).line(0, 0, -2).line(0, 50, -2);  // a slot, then round a corner
  made.rapid(-50, -43, -2).line(50, -43, -2);             // a side pass
  const Course found = run(made, tool, block);
  const auto cause = [&](double x, double y) {
    const auto row = std::ranges::min_element(found.rows, {}, [&](const Step& step) {
      return std::hypot(step.place[0] - x * unit::mm, step.place[1] - y * unit::mm);
    });
    return row->cause;
  };
  EXPECT_EQ(cause(-48, 0), Cause::air);
  EXPECT_EQ(cause(-44.95, 0), Cause::entry);
  EXPECT_EQ(cause(-20, 0), Cause::slot);
  EXPECT_EQ(cause(0, 20), Cause::slot);
  EXPECT_EQ(cause(0, -43), Cause::side);
  EXPECT_EQ(found.summary.lines.back().cause, Cause::side);
  EXPECT_EQ(found.summary.lines.front().cause, Cause::slot);
  const auto flagged = std::ranges::count_if(found.rows, [](const Step& step) {
    return (step.flags & straight_after_corner) != 0;
  });
  EXPECT_EQ(flagged, 1);
}

TEST(Steps, ARapidThroughStockAndASpindleThatStandsAreTold) {
  const Tool tool = end_mill(10, 2, 30);
  MadeProgram made(1000, 100);
  made.rapid(-50, 0, -2).rapid(50, 0, -2);
  EXPECT_EQ(run(made, tool, block).summary.warnings.front().code,
            "rapid_through_stock");
  MadeProgram above(1000, 100);
  above.rapid(-50, 0, 2).rapid(50, 0, 2).line(50, 50, 2);
  EXPECT_TRUE(run(above, tool, block).summary.warnings.empty());
  MadeProgram stands(0, 100);
  stands.rapid(-50, 0, -2).line(50, 0, -2);
  const Course found = run(stands, tool, block);
  EXPECT_EQ(found.summary.warnings.front().code, "spindle_stands");
  EXPECT_EQ(found.summary.totals.peak_xy.value, 0.0);
}

TEST(Steps, TheSameBitsOnAnyNumberOfThreads) {
  const Tool tool = end_mill(6, 2, 30, {0, -5});
  MadeProgram made(5000, 400);
  made.rapid(-45, 0, -2).line(0, 0, -2).arc(0, 8, 300, -2).line(30, 30, -1);
  const auto digest = [&](int threads) {
    const numerics::ThreadLimit limit(threads);
    std::vector<double> out;
    for (const Step& step : run(made, tool, block).rows) {
      out.insert(out.end(), {step.forces.peak_xy, step.forces.mean[0], step.removed});
    }
    return out;
  };
  EXPECT_EQ(digest(1), digest(4));
}

TEST(Steps, StepsInAirAreOneRow) {
  const Tool tool = end_mill(10, 2, 30);
  const Course found = run(side_pass(-43), tool, block);
  EXPECT_EQ(found.rows.front().step, 0);
  EXPECT_GT(found.rows.front().count, 40);
  double turns = 0.0;
  for (const Step& step : found.rows) turns += step.turns;
  EXPECT_NEAR(turns, 1000.0, 1e-9);
  EXPECT_EQ(found.summary.totals.steps, 1000);
  EXPECT_NEAR(step_count({side_pass(-43).program, std::span(&tool, 1), block, {}}),
              1000.0, 0.0);
}

}  // namespace trochoid::engagement::steps_test
