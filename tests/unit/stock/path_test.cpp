#include <trochoid/base/units.h>
#include <trochoid/stock/path.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace trochoid::stock::path_test {

using program::Move;
using program::MoveKind;

Move line(double x, double y, double z) {
  return {.end = {x, y, z},
          .feed = 0.01,
          .spindle = 10 * unit::turn,
          .line = 1,
          .tool = 0,
          .kind = MoveKind::line};
}

Move rapid(double x, double y, double z) {
  Move move = line(x, y, z);
  move.feed = 0.0;
  move.kind = MoveKind::rapid;
  return move;
}

TEST(Path, TurnsOfTheSpindleGoWithTheTime) {  // [N-1]
  const std::vector<Move> moves{rapid(0, 0, 0), line(0.02, 0, 0), line(0.02, 0.01, 0)};
  const Path path = stock::path(moves, 0.1);
  ASSERT_EQ(path.pieces.size(), 2u);  // the first rapid comes from an unknown place
  EXPECT_NEAR(path.pieces[0].turns_to, 20.0, 1e-12);
  EXPECT_NEAR(path.pieces[0].feed_per_turn(), 1e-3, 1e-15);
  EXPECT_NEAR(path.time, 3.0, 1e-12);
  EXPECT_NEAR(path.turns, 30.0, 1e-11);
}

TEST(Path, CollinearMovesAreOnePiece) {
  std::vector<Move> moves{rapid(0, 0, 0)};
  for (int i = 1; i <= 7; ++i) moves.push_back(line(0.003 * i, 0.004 * i, -1e-4 * i));
  moves.push_back(line(0.0, 0.0, 0.0));  // back along the same line: another piece
  const Path path = stock::path(moves, 0.1);
  ASSERT_EQ(path.pieces.size(), 2u);
  EXPECT_NEAR(path.pieces[0].length, 7 * std::hypot(0.005, 1e-4), 1e-15);
  EXPECT_NEAR(path.begins[4], 3 * std::hypot(0.005, 1e-4), 1e-15);
  EXPECT_EQ(path.pieces[0].first, 1u);
  EXPECT_EQ(path.pieces[0].last, 7u);
}

TEST(Path, AnotherFeedBeginsAnotherPiece) {
  std::vector<Move> moves{rapid(0, 0, 0), line(0.01, 0, 0), line(0.02, 0, 0)};
  moves[2].feed = 0.02;
  EXPECT_EQ(stock::path(moves, 0.1).pieces.size(), 2u);
}

TEST(Path, AnArcEndsWhereItsTurnEnds) {
  Move arc = line(0.0, 0.01, -0.002);
  arc.kind = MoveKind::arc;
  arc.center = {0.0, 0.0};
  arc.turn = 2.5 * std::numbers::pi;
  const std::vector<Move> moves{rapid(0.01, 0, 0), arc};
  const Path path = stock::path(moves, 0.1);
  const Piece& piece = path.pieces.front();
  EXPECT_NEAR(piece.horizontal, 0.01 * arc.turn, 1e-15);
  const PathPoint end = point_at(piece, 1.0);
  EXPECT_NEAR(end.place[0], 0.0, 1e-15);
  EXPECT_NEAR(end.place[1], 0.01, 1e-15);
  EXPECT_NEAR(end.place[2], -0.002, 1e-18);
  EXPECT_NEAR(std::remainder(end.direction - std::numbers::pi, unit::turn), 0.0, 1e-12);
}

}  // namespace trochoid::stock::path_test
