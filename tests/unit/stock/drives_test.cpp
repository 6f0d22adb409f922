#include <trochoid/base/units.h>
#include <trochoid/stock/drives.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace trochoid::stock::drives_test {

using program::Move;
using program::MoveKind;

constexpr double v = 0.1;  // m/s
constexpr double a = 2.0;  // m/s^2

Move line(double x, double y) {
  return {.end = {x, y, 0.0},
          .feed = v,
          .spindle = 10 * unit::turn,
          .line = 1,
          .tool = 0,
          .kind = MoveKind::line};
}

Path made(std::vector<Move> moves) {
  Move start = line(0, 0);
  start.kind = MoveKind::rapid;
  start.feed = 0.0;
  moves.insert(moves.begin(), start);
  return path(moves, 0.2);
}

TEST(Drives, ASingleLineIsATrapezium) {  // [N-12]
  Path p = made({line(0.05, 0)});
  const std::vector<Speed> speeds = stock::speeds(p, 0.2, {.acceleration = {a, a, a}});
  ASSERT_EQ(speeds.size(), 1U);
  const double way = v * v / (2 * a);
  EXPECT_NEAR(speed_at(speeds[0], 0.05, 0.0), 0.0, 1e-12);
  EXPECT_NEAR(speed_at(speeds[0], 0.05, way / 4), v / 2, 1e-12);
  EXPECT_NEAR(speed_at(speeds[0], 0.05, 0.025), v, 1e-12);
  EXPECT_NEAR(speed_at(speeds[0], 0.05, 0.05 - way / 4), v / 2, 1e-12);
  EXPECT_NEAR(p.time, 0.05 / v + v / a, 1e-12);
  EXPECT_NEAR(p.turns, 10 * p.time, 1e-9);
  EXPECT_NEAR(time_to(speeds[0], 0.05, way), v / a, 1e-12);
  EXPECT_NEAR(time_to(speeds[0], 0.05, 0.05 - way), p.time - v / a, 1e-12);
}

TEST(Drives, AShortLineDoesNotReachItsFeed) {
  const double l = 1e-3;
  Path p = made({line(l, 0)});
  const std::vector<Speed> speeds = stock::speeds(p, 0.2, {.acceleration = {a, a, a}});
  EXPECT_NEAR(speed_at(speeds[0], l, l / 2), std::sqrt(a * l), 1e-12);
  EXPECT_NEAR(p.time, 2 * std::sqrt(l / a), 1e-12);
}

TEST(Drives, TimeIsTheIntegralOfOneOverTheSpeed) {
  Path p = made({line(0.02, 0), line(0.021, 0.003), line(0.022, 0.03)});
  const Drives drives{.acceleration = {3, 2, 1}, .corner_tolerance = 0.2e-3};
  const std::vector<Speed> speeds = stock::speeds(p, 0.2, drives);
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const double l = p.pieces[i].length;
    const double from = 0.1 * l;
    const double to = 0.9 * l;
    double sum = 0.0;
    constexpr int n = 20000;
    for (int k = 0; k < n; ++k) {
      sum +=
          (to - from) / n / speed_at(speeds[i], l, from + (k + 0.5) * (to - from) / n);
    }
    EXPECT_NEAR(time_to(speeds[i], l, to) - time_to(speeds[i], l, from), sum, 1e-7);
    EXPECT_NEAR(p.pieces[i].time_to - p.pieces[i].time_from, time_to(speeds[i], l, l),
                1e-12);
  }
}

TEST(Drives, AKinkStopsAndASmoothOneDoesNot) {  // [N-13]
  const auto last_of_first = [](double degrees, double tolerance) {
    const double t = degrees * unit::deg;
    Path p = made({line(0.05, 0), line(0.05 + 0.05 * std::cos(t), 0.05 * std::sin(t))});
    return stock::speeds(p, 0.2,
                         {.acceleration = {a, a, a}, .corner_tolerance = tolerance})[0];
  };
  EXPECT_NEAR(last_of_first(90, 0.0).last, 0.0, 1e-12);
  EXPECT_NEAR(last_of_first(0.5, 0.0).last, v, 1e-12);
  // The circle that comes within d of the corner: r = d cos(t/2)/(1 - cos(t/2)); both
  // axes brake along the bisector, a sqrt(2).
  const double half = std::cos(45 * unit::deg);
  const double d = 0.1e-3;
  EXPECT_NEAR(last_of_first(90, d).last,
              std::sqrt(a * std::sqrt(2.0) * d * half / (1 - half)), 1e-12);
}

TEST(Drives, AnArcIsAsFastAsItsRadiusAllows) {  // [N-13]
  Move arc = line(0.0, 0.01);
  arc.kind = MoveKind::arc;
  arc.center = {0.0, 0.005};
  arc.turn = std::numbers::pi;
  arc.feed = 1.0;
  Path p = made({arc});
  const Speed speed = stock::speeds(p, 2.0, {.acceleration = {2, 3, 1}})[0];
  EXPECT_NEAR(speed.most, std::sqrt(2 * 0.005), 1e-12);
}

TEST(Drives, AnAxisHasItsOwnFeed) {
  Path p = made({line(0.3, 0.4)});
  Drives drives{.acceleration = {3, 2, 1}};
  drives.feed[1] = 0.04;
  const Speed speed = stock::speeds(p, 2.0, drives)[0];
  EXPECT_NEAR(speed.most, 0.05, 1e-12);
  EXPECT_NEAR(speed.acceleration, std::min(3 / 0.6, 2 / 0.8), 1e-12);
}

}  // namespace trochoid::stock::drives_test
