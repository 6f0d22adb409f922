#include <trochoid/base/units.h>
#include <trochoid/stock/solid.h>
#include <trochoid/stock/swept.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace trochoid::stock::curved_test {

using program::Move;
using program::MoveKind;
using std::numbers::pi;

const Box block{{-0.03, -0.03, -0.02}, {0.03, 0.03, 0.0}};

double ball_radius(double R, double z) {
  return z < R ? std::sqrt(std::max(z * (2 * R - z), 0.0)) : R;
}

Wall ball(double R) {
  const std::array<double, 2> ends{0.0, R};
  return {ends, [R](double z) { return ball_radius(R, z); }};
}

/// A bull nose on a cone: flat, a corner, a flank that leans.
double taper_radius(double z) {
  constexpr double corner = 1e-3;
  const double tangent = corner * (1 - std::sin(0.1));  // where the flank begins
  if (z < tangent) return 2e-3 + std::sqrt(z * (2 * corner - z));
  return 2e-3 + corner * std::cos(0.1) + (z - tangent) * std::tan(0.1);
}

Wall taper() {
  const std::array<double, 3> ends{0.0, 1e-3 * (1 - std::sin(0.1)), 8e-3};
  return {ends, taper_radius};
}

Move move(MoveKind kind, double x, double y, double z) {
  return {.end = {x, y, z},
          .feed = kind == MoveKind::rapid ? 0.0 : 0.005,
          .spindle = 20 * unit::turn,
          .line = 1,
          .tool = 0,
          .kind = kind};
}

/// Lines, ramps, plunges, arcs and helices, here and there.
std::vector<Move> wild_moves(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-0.02, 0.02);
  std::uniform_real_distribution<double> depth(-0.006, 0.0);
  std::uniform_real_distribution<double> angle(-4.0, 4.0);
  std::vector<Move> moves{move(MoveKind::rapid, 0, 0, 0.001)};
  for (int i = 0; i < 12; ++i) {
    const auto& at = moves.back().end;
    const double z = i % 3 == 0 ? at[2] : depth(random);
    if (i % 4 == 1) {
      const double cx = at[0] + 0.3 * place(random);
      const double cy = at[1] + 0.3 * place(random);
      const double turn = angle(random);
      const double radius = std::hypot(at[0] - cx, at[1] - cy);
      const double end = std::atan2(at[1] - cy, at[0] - cx) + turn;
      moves.push_back(move(MoveKind::arc, cx + radius * std::cos(end),
                           cy + radius * std::sin(end), z));
      moves.back().center = {cx, cy};
      moves.back().turn = turn;
    } else if (i % 5 == 4) {
      moves.push_back(move(MoveKind::line, at[0], at[1], depth(random)));
    } else {
      moves.push_back(move(MoveKind::line, place(random), place(random), z));
    }
  }
  return moves;
}

/// Whether the wall of the tool, made wider by the slack, is over a point.
bool swept_by_sampling(const Path& path, const Wall& wall, const Point& q, double turns,
                       double slack) {
  for (const Piece& piece : path.pieces) {
    constexpr int n = 2000;
    for (int i = 0; i <= n; ++i) {
      const double u = static_cast<double>(i) / n;
      if (piece.turns_from + u * (piece.turns_to - piece.turns_from) > turns) break;
      const Point tip = point_at(piece, u).place;
      const double r = wall.radius(q[2] - tip[2]);
      if (r > 0 && std::hypot(tip[0] - q[0], tip[1] - q[1]) < r + slack) return true;
    }
  }
  return false;
}

TEST(Wall, IsTheRadiusOfItsTool) {
  constexpr double R = 3e-3;
  const Wall wall = ball(R);
  EXPECT_FALSE(wall.is_upright());
  for (double z = 1e-7; z < 5e-3; z *= 1.31) {
    EXPECT_NEAR(wall.radius(z), ball_radius(R, z), 1e-8 * R) << z;
    const double slope = z < R ? (R - z) / ball_radius(R, z) : 0.0;
    EXPECT_NEAR(wall.at(z).slope, slope, 1e-5 * (1 + slope)) << z;
    if (z < R) {
      EXPECT_NEAR(wall.height_at(ball_radius(R, z)), z, 2e-6 * R) << z;
    }
  }
  EXPECT_EQ(wall.radius(-1e-9), 0.0);
  EXPECT_TRUE(std::isinf(wall.height_at(1.001 * R)));
  EXPECT_EQ(Wall::upright(R).radius(1.0), R);
  EXPECT_EQ(Wall::upright(R).height_at(0.5 * R), 0.0);
}

TEST(Swept, ArcsOfCurvedToolsAreThePointsThatNoPlaceOfThemCovers) {  // [N-3] [N-16]
  int looked = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Wall wall = seed % 2 == 0 ? ball(4e-3) : taper();
    const Swept swept(stock::path(wild_moves(seed), 0.1), block, {wall});
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-0.015, 0.015);
    for (int k = 0; k < 4; ++k) {
      const Place at{
          .tip = {place(random), place(random), -0.005 + 0.3 * place(random)},
          .direction = 100 * place(random),
          .turns = swept.path().turns * (k + 1) / 4,
          .last = static_cast<std::uint32_t>(swept.path().pieces.size() - 1)};
      const double height = 1e-4 * std::pow(4.0, k);
      const double r = wall.radius(height);
      const auto arcs = Surroundings(swept, at, wall.largest()).arcs(height, r);
      for (double theta = -1.5; theta < 4.7; theta += 0.15) {
        const double angle = at.direction + pi / 2 - theta;
        const Point q{at.tip[0] + r * std::cos(angle), at.tip[1] + r * std::sin(angle),
                      at.tip[2] + height};
        const bool surely = swept_by_sampling(swept.path(), wall, q, at.turns, -1e-5);
        const bool perhaps = swept_by_sampling(swept.path(), wall, q, at.turns, 1e-5);
        if (surely != perhaps) continue;
        bool stock = false;
        for (const auto& arc : arcs) {
          const double ahead = theta - arc.arc.from;
          stock |= ahead - unit::turn * std::floor(ahead / unit::turn) <
                   arc.arc.to - arc.arc.from;
        }
        EXPECT_EQ(stock, !surely && contains(block, q[0], q[1], q[2]))
            << seed << ' ' << k << ' ' << theta;
        ++looked;
      }
    }
  }
  EXPECT_GT(looked, 1000);
}

/// Lines of a ball beside one another, up and down a hill.
std::vector<Move> raster(double step, double block_length) {
  std::vector<Move> moves{move(MoveKind::rapid, -0.012, -0.01, 0.01)};
  bool back = false;
  for (double y = -0.01; y < 0.01; y += step) {
    const int n = static_cast<int>(0.02 / block_length);
    for (int i = 0; i <= n; ++i) {
      const double x = -0.01 + block_length * (back ? n - i : i);
      moves.push_back(move(MoveKind::line, x, y,
                           -2e-3 - 1e-3 * std::cos(200 * x) * std::cos(150 * y)));
    }
    back = !back;
  }
  return moves;
}

TEST(Swept, TheMapOfHeightsNamesThePiecesThatCount) {  // [N-3] [N-17]
  Swept all(stock::path(raster(0.5e-3, 0.4e-3), 0.1), block, {ball(3e-3)});
  Swept few = all;
  few.keep_map(0.15e-3);
  const auto& pieces = all.path().pieces;
  std::size_t looked = 0;
  std::size_t named = 0;
  for (std::uint32_t i = 300; i < pieces.size(); i += 31) {
    const Place at{.tip = point_at(pieces[i], 0.5).place,
                   .direction = point_at(pieces[i], 0.5).direction,
                   .turns = 0.5 * (pieces[i].turns_from + pieces[i].turns_to) - 1,
                   .last = i};
    few.sweep_to(at.turns);
    named = std::max(named, few.near(at, 3e-3).pieces.size());
    for (const double height : {2e-5, 1e-4, 5e-4, 1e-3}) {
      const double r = ball_radius(3e-3, height);
      const auto a = Surroundings(all, at, 3e-3).arcs(height, r);
      const auto b = Surroundings(few, at, 3e-3).arcs(height, r);
      double stock_a = 0.0;
      double stock_b = 0.0;
      for (const auto& arc : a) stock_a += arc.arc.to - arc.arc.from;
      for (const auto& arc : b) stock_b += arc.arc.to - arc.arc.from;
      EXPECT_NEAR(stock_a, stock_b, 2e-3) << i << ' ' << height;
      ++looked;
    }
  }
  EXPECT_GT(looked, 200u);
  EXPECT_LT(named, 120u);
  EXPECT_GT(all.near({.turns = 1e9, .last = 1u << 30}, 3e-3).pieces.size(), 500u);
}

TEST(HeightMap, TakesTheVolumeOfASlotOfABall) {  // [N-17]
  constexpr double R = 4e-3;
  constexpr double depth = 1.5e-3;
  const std::vector<Move> moves{move(MoveKind::rapid, -0.05, 1e-4, -depth),
                                move(MoveKind::line, 0.05, 1e-4, -depth)};
  Swept swept(stock::path(moves, 0.1), block, {ball(R)});
  swept.keep_map(0.1e-3);
  swept.sweep_to(1e9);
  const double section = R * R * std::acos(1 - depth / R) -
                         (R - depth) * std::sqrt(depth * (2 * R - depth));
  EXPECT_NEAR(swept.map()->removed(block), section * 0.06, 2e-3 * section * 0.06);
}

TEST(HeightMap, AHeightIsTheLowestThatAPieceLeaves) {  // [N-17]
  const Wall wall = ball(3e-3);
  const Path path =
      stock::path(std::vector<Move>{move(MoveKind::rapid, 0, 0, -1e-3),
                                    move(MoveKind::line, 5e-3, 1e-3, -3e-3)},
                  0.1);
  const Piece& piece = path.pieces.back();
  for (double x = -2e-3; x < 7e-3; x += 0.7e-3) {
    for (double y = -2e-3; y < 3e-3; y += 0.6e-3) {
      double lowest = 1.0;
      for (int i = 0; i <= 2000; ++i) {
        const Point tip = point_at(piece, i / 2000.0).place;
        const double d = std::hypot(tip[0] - x, tip[1] - y);
        if (d < 3e-3) {
          lowest = std::min(lowest, tip[2] + 3e-3 - std::sqrt(9e-6 - d * d));
        }
      }
      if (lowest < 1.0) {
        EXPECT_NEAR(height_left(piece, wall, x, y), lowest, 2e-8) << x << ' ' << y;
      }
    }
  }
}

/// A box of twelve faces.
std::vector<Triangle> box_of_faces(Point a, Point b) {
  const auto corner = [&](int i) {
    return Point{(i & 1) != 0 ? b[0] : a[0], (i & 2) != 0 ? b[1] : a[1],
                 (i & 4) != 0 ? b[2] : a[2]};
  };
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  std::vector<Triangle> out;
  for (const auto& f : faces) {
    out.push_back({corner(f[0]), corner(f[1]), corner(f[2])});
    out.push_back({corner(f[0]), corner(f[2]), corner(f[3])});
  }
  return out;
}

TEST(Solid, OfABoxIsItsHeight) {
  const auto faces = box_of_faces({0, 0, -0.02}, {0.03, 0.02, 0.0});
  EXPECT_EQ(open_edges(faces), 0u);
  const FromAbove seen = seen_from_above(faces, 1e-3);
  EXPECT_FALSE(seen.undercut);
  EXPECT_NEAR(volume(seen.field), 0.03 * 0.02 * 0.02, 1e-12);
  EXPECT_NEAR(top_at(seen.field, 0.0117, 0.0063), 0.0, 1e-9);
  EXPECT_EQ(heights(seen.field).bottom, -0.02);
}

TEST(Solid, ThatIsOpenOrHollowIsTold) {
  auto faces = box_of_faces({0, 0, -0.02}, {0.03, 0.02, 0.0});
  const auto bridge = box_of_faces({0, 0.03, -0.01}, {0.03, 0.05, 0.0});
  faces.insert(faces.end(), bridge.begin(), bridge.end());
  EXPECT_TRUE(seen_from_above(faces, 1e-3).undercut);
  faces.pop_back();
  EXPECT_EQ(open_edges(faces), 3u);
}

}  // namespace trochoid::stock::curved_test
