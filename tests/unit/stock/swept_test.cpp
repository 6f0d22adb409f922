#include <trochoid/base/units.h>
#include <trochoid/stock/swept.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace trochoid::stock::swept_test {

using program::Move;
using program::MoveKind;
using std::numbers::pi;

const Box box{{-0.05, -0.05, -0.02}, {0.05, 0.05, 0.0}};

Move move(MoveKind kind, double x, double y, double z) {
  return {.end = {x, y, z},
          .feed = kind == MoveKind::rapid ? 0.0 : 0.005,
          .spindle = 20 * unit::turn,
          .line = 1,
          .tool = 0,
          .kind = kind};
}

Move arc(double x, double y, double z, std::array<double, 2> center, double turn) {
  Move out = move(MoveKind::arc, x, y, z);
  out.center = center;
  out.turn = turn;
  return out;
}

/// Lines, ramps, arcs and helices, here and there.
std::vector<Move> wild_moves(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-0.03, 0.03);
  std::uniform_real_distribution<double> depth(-0.006, 0.001);
  std::uniform_real_distribution<double> angle(-7.0, 7.0);
  std::vector<Move> moves{move(MoveKind::rapid, 0, 0, 0.001)};
  for (int i = 0; i < 14; ++i) {
    const auto& at = moves.back().end;
    if (i % 3 == 1) {
      const double cx = at[0] + 0.2 * place(random);
      const double cy = at[1] + 0.2 * place(random);
      const double turn = angle(random);
      const double radius = std::hypot(at[0] - cx, at[1] - cy);
      const double end = std::atan2(at[1] - cy, at[0] - cx) + turn;
      moves.push_back(arc(cx + radius * std::cos(end), cy + radius * std::sin(end),
                          i % 2 == 0 ? at[2] : depth(random), {cx, cy}, turn));
    } else {
      moves.push_back(move(i % 7 == 3 ? MoveKind::rapid : MoveKind::line, place(random),
                           place(random), i % 2 == 0 ? at[2] : depth(random)));
    }
  }
  return moves;
}

/// Many short blocks, as CAM programs have them: to and fro, crossing one another.
std::vector<Move> short_moves(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> bend(-0.35, 0.35);
  std::uniform_real_distribution<double> length(1e-4, 8e-4);
  std::vector<Move> moves{move(MoveKind::rapid, 0, 0, 0.001)};
  double x = 0.01;
  double y = 0.0;
  double z = -0.002;
  double angle = 1.0;
  for (int i = 0; i < 400; ++i) {
    angle += bend(random);
    if (std::hypot(x, y) > 0.02) angle = std::atan2(-y, -x) + 2 * bend(random);
    const double step = length(random);
    x += step * std::cos(angle);
    y += step * std::sin(angle);
    if (i == 150) z = -0.003;
    moves.push_back(move(MoveKind::line, x, y, z));
  }
  return moves;
}

/// A clearing in short blocks: three deep rows, then rows over all of it.
std::vector<Move> rows_of_blocks(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> length(1e-4, 5e-4);
  std::vector<Move> moves{move(MoveKind::rapid, -0.012, -0.012, -0.002)};
  for (int row = 0; row < 26; ++row) {
    const double z = row < 3 ? -0.003 : -0.002;
    const double y = -0.012 + 1.3e-3 * (row < 3 ? row + 8 : row - 3);
    for (double s = -0.012; s < 0.012; s += length(random)) {
      const double x = row % 2 == 0 ? s : -s;
      moves.push_back(move(MoveKind::line, x, y + 4e-4 * std::sin(400 * x + seed), z));
    }
  }
  return moves;
}

/// Distance of a point at a height from all that was swept, by many places of the tip.
bool swept_by_sampling(const Path& path, double R, double x, double y, double z,
                       double turns, double slack) {
  for (const Piece& piece : path.pieces) {
    const int n = static_cast<int>(piece.length / 3e-6) + 10;
    for (int i = 0; i <= n; ++i) {
      const double u = static_cast<double>(i) / n;
      const double T = piece.turns_from + u * (piece.turns_to - piece.turns_from);
      if (T > turns) break;
      const Point tip = point_at(piece, u).place;
      if (tip[2] <= z && std::hypot(tip[0] - x, tip[1] - y) < R + slack) return true;
    }
  }
  return false;
}

/// Compares arcs at places with what sampling tells; how often.
int compare_arcs(std::vector<Move> (*moves)(unsigned seed), double across) {
  constexpr double R = 5e-3;
  int looked = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Swept swept(stock::path(moves(seed), 0.1), box, {Wall::upright(R)});
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-across, across);
    for (int k = 0; k < 3; ++k) {
      const auto last = static_cast<std::uint32_t>(swept.path().pieces.size() - 1);
      const Place at{.tip = {place(random), place(random), -0.003},
                     .direction = 100 * place(random),
                     .turns = swept.path().turns * (k + 1) / 3,
                     .last = last};
      const Surroundings around(swept, at, R);
      const double height = 1e-3 * ((k + static_cast<int>(seed)) % 3);
      const auto arcs = around.arcs(height, R);
      for (double theta = -1.5; theta < 4.7; theta += 0.21) {
        const double angle = at.direction + pi / 2 - theta;
        const double x = at.tip[0] + R * std::cos(angle);
        const double y = at.tip[1] + R * std::sin(angle);
        const double z = at.tip[2] + height;
        const bool surely =
            swept_by_sampling(swept.path(), R, x, y, z, at.turns, -1e-5);
        const bool perhaps =
            swept_by_sampling(swept.path(), R, x, y, z, at.turns, 1e-5);
        if (surely != perhaps) continue;
        bool stock = false;
        for (const auto& arc : arcs) {
          const double ahead = theta - arc.arc.from;
          stock |= ahead - unit::turn * std::floor(ahead / unit::turn) <
                   arc.arc.to - arc.arc.from;
        }
        EXPECT_EQ(stock, !surely && contains(box, x, y, z))
            << seed << ' ' << k << ' ' << theta;
        ++looked;
      }
    }
  }
  return looked;
}

TEST(Swept, ArcsAreThePointsThatNoPlaceOfTheCutterCovers) {  // [N-3]
  EXPECT_GT(compare_arcs(wild_moves, 0.03), 400);
}

TEST(Swept, ArcsBesideManyShortBlocksAreTheseToo) {  // [N-3]
  EXPECT_GT(compare_arcs(short_moves, 0.02), 400);
}

TEST(Swept, ArcsInAClearingOfShortBlocksAreTheseToo) {  // [N-3] [N-27]
  EXPECT_GT(compare_arcs(rows_of_blocks, 0.014), 350);
  const Swept swept(stock::path(rows_of_blocks(1), 0.1), box, {Wall::upright(5e-3)});
  std::size_t hidden = 0;
  for (const Chain& chain : swept.chains()) hidden += chain.is_hidden() ? 1U : 0U;
  EXPECT_GT(hidden, swept.chains().size() / 2);
  EXPECT_LT(swept.chains().size(), swept.path().pieces.size() / 3);
}

TEST(Swept, ACircleOnTheAxisOfAnOldSlotOfItsOwnMeetsNothing) {  // [N-3]
  const std::vector<Move> moves{move(MoveKind::rapid, -0.04, 0, -0.002),
                                move(MoveKind::line, 0.04, 0, -0.002)};
  const Swept swept(stock::path(moves, 0.1), box, {Wall::upright(5e-3)});
  for (const double direction : {0.0, 0.3, pi}) {
    const Surroundings around(
        swept, {.tip = {0, 0, -0.002}, .direction = direction, .turns = 1e9, .last = 9},
        5e-3);
    EXPECT_TRUE(around.arcs(1e-3, 5e-3).empty());
    EXPECT_TRUE(around.arcs(1e-3, 4e-3).empty());
    EXPECT_EQ(around.arcs(1e-3, 6e-3).size(), 2u);
  }
}

// What covers half of the circle begins or ends straight behind, where the circle is cut
// open: rounding puts it on either side.
TEST(Swept, AnArcMayBeginWhereTheCircleIsCutOpen) {  // [N-3]
  constexpr double R = 5e-3;
  const std::vector<Wall> walls{Wall::upright(R)};
  for (int i = 0; i < 500; ++i) {
    const double direction = 0.0127 * i;
    const double c = std::cos(direction);
    const double s = std::sin(direction);
    for (const double side : {-R, R}) {
      const double x = -s * side;
      const double y = c * side;
      const std::vector<Move> moves{
          move(MoveKind::rapid, x - 0.02 * c, y - 0.02 * s, -0.002),
          move(MoveKind::line, x + 0.02 * c, y + 0.02 * s, -0.002)};
      const Swept swept(stock::path(moves, 0.1), box, walls);
      const Surroundings around(
          swept,
          {.tip = {0, 0, -0.002}, .direction = direction, .turns = 1e9, .last = 9}, R);
      const auto arcs = around.arcs(1e-3, R);
      ASSERT_EQ(arcs.size(), 1u) << direction;
      EXPECT_NEAR(arcs[0].arc.to - arcs[0].arc.from, pi, 1e-6) << direction;
      const double middle = 0.5 * (arcs[0].arc.from + arcs[0].arc.to);
      EXPECT_NEAR(std::cos(middle), side > 0 ? -1.0 : 1.0, 1e-6) << direction;
    }
  }
}

TEST(Swept, WhatIsAboveTheTipOrLaterIsNotSwept) {  // [N-2]
  const std::vector<Move> moves{move(MoveKind::rapid, -0.04, 0, -0.002),
                                move(MoveKind::line, 0.04, 0, -0.002)};
  const Swept swept(stock::path(moves, 0.1), box, {Wall::upright(5e-3)});
  const Place at{.tip = {0, 0.001, -0.004}, .turns = 1e9, .last = 9};
  const Surroundings around(swept, at, 5e-3);
  EXPECT_EQ(around.arcs(1e-3, 5e-3).size(), 1u);  // below its floor: a whole circle
  EXPECT_NEAR(around.arcs(1e-3, 5e-3)[0].arc.to - around.arcs(1e-3, 5e-3)[0].arc.from,
              unit::turn, 1e-12);
  EXPECT_NEAR(around.arcs(3e-3, 5e-3)[0].arc.to - around.arcs(3e-3, 5e-3)[0].arc.from,
              2 * std::acos(0.8), 0.4);
  Place early = at;
  early.turns = swept.path().pieces[0].turns_to * 0.4;  // not there yet
  EXPECT_NEAR(Surroundings(swept, early, 5e-3).arcs(3e-3, 5e-3)[0].arc.to -
                  Surroundings(swept, early, 5e-3).arcs(3e-3, 5e-3)[0].arc.from,
              unit::turn, 1.7);
}

TEST(Swept, LayersBeginWhereFloorsDo) {
  const std::vector<Move> moves{move(MoveKind::rapid, -0.04, 0, -0.002),
                                move(MoveKind::line, 0.04, 0, -0.002)};
  const Swept swept(stock::path(moves, 0.1), box, {Wall::upright(5e-3)});
  const Surroundings around(swept, {.tip = {0, 0.001, -0.005}, .turns = 1e9, .last = 9},
                            5e-3);
  const std::vector<double> z = around.heights({4, 24});
  ASSERT_EQ(z.size(), 3u);
  EXPECT_NEAR(z[1], 0.003, 1e-15);
  EXPECT_NEAR(z[2], 0.005, 1e-15);
}

TEST(Swept, AVolumeIsThatOfItsSlot) {  // [N-9]
  const std::vector<Move> moves{move(MoveKind::rapid, -0.03, 0, 0.001),
                                move(MoveKind::line, -0.03, 0, -0.002),
                                move(MoveKind::line, 0.03, 0.01, -0.002)};
  const Swept swept(stock::path(moves, 0.1), box, {Wall::upright(5e-3)});
  const double area = pi * 25e-6 + 10e-3 * std::hypot(0.06, 0.01);
  EXPECT_NEAR(volume_removed(swept, 1e-5), area * 2e-3, 1e-4 * area * 2e-3);
}

TEST(Swept, WallsAlongTheLinesOfTheScanAreNoError) {  // [N-9]
  // Beside another slot, so that its wall is not where the scan begins.
  const std::vector<Move> moves{move(MoveKind::rapid, -0.05, 0.0, -0.002),
                                move(MoveKind::line, 0.05, 0.0, -0.002),
                                move(MoveKind::rapid, 0.05, 0.0201, -0.002),
                                move(MoveKind::line, -0.05, 0.0201, -0.002)};
  const Initial thin = Box{{-0.03, 0.01505, -0.01}, {0.03, 0.0152, 0.0}};
  const Swept swept(stock::path(moves, 0.1), thin, {Wall::upright(5e-3)});
  const double volume = 0.06 * (0.0152 - 0.0151) * 2e-3;
  EXPECT_NEAR(volume_removed(swept, 1e-4), volume, 1e-6 * volume);
}

TEST(Swept, AVolumeOfARingIsThatOfItsRing) {  // [N-9]
  const std::vector<Move> moves{move(MoveKind::rapid, 0.02, 0, 0.001),
                                move(MoveKind::line, 0.02, 0, -0.002),
                                arc(0.02, 0, -0.002, {0.0, 0.0}, unit::turn)};
  const Swept swept(stock::path(moves, 0.1), box, {Wall::upright(5e-3)});
  const double area = pi * (625e-6 - 225e-6);
  EXPECT_NEAR(volume_removed(swept, 1e-5), area * 2e-3, 1e-4 * area * 2e-3);
}

TEST(Swept, AThinRidgeBetweenTwoSlotsStays) {  // [N-9]
  const double x = 10.4e-3;                    // a ridge of 0.4 mm
  const std::vector<Move> moves{
      move(MoveKind::rapid, 0, -0.02, 0.001), move(MoveKind::line, 0, -0.02, -0.002),
      move(MoveKind::line, 0, 0.02, -0.002),  move(MoveKind::rapid, 0, 0.02, 0.001),
      move(MoveKind::rapid, x, 0.02, 0.001),  move(MoveKind::line, x, 0.02, -0.002),
      move(MoveKind::line, x, -0.02, -0.002)};
  const Swept swept(stock::path(moves, 0.1), box, {Wall::upright(5e-3)});
  const double area = 2 * (pi * 25e-6 + 10e-3 * 0.04);
  EXPECT_NEAR(volume_removed(swept, 1e-5), area * 2e-3, 1e-4 * area * 2e-3);
}

TEST(Stock, AFieldOfHeightsIsLinearBetweenItsPoints) {
  HeightField field{{0.0, 0.0}, 1.0, 3, 2, -1.0, {0, 1, 2, 0, 1, 4}, 4.0};
  EXPECT_DOUBLE_EQ(top_at(field, 0.5, 0.5), 0.5);
  EXPECT_DOUBLE_EQ(top_at(field, 2.0, 1.0), 4.0);
  EXPECT_DOUBLE_EQ(top_at(field, 2.1, 1.0), -1.0);
  EXPECT_TRUE(contains(field, 1.5, 0.0, 1.4));
  EXPECT_FALSE(contains(field, 1.5, 0.0, 1.6));
  EXPECT_DOUBLE_EQ(volume(field), 2 * (1 + 1) + (2.0 + (8 - 6) / 4.0) - 2 - 0.5 + 0.5);
}

}  // namespace trochoid::stock::swept_test
