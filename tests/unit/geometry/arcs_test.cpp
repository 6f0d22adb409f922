#include <trochoid/base/units.h>
#include <trochoid/geometry/arcs.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace trochoid::geometry::arcs_test {

/// Whether a point of the ray at theta is on the side of the stock, from the words alone.
bool in_stock(const StockBoundary& b, double theta, double r) {
  const double x = r * std::sin(theta);
  const double y = r * std::cos(theta);
  const double nx = std::sin(b.beta);
  const double ny = std::cos(b.beta);
  if (b.kind == StockBoundary::Kind::line) return x * nx + y * ny > b.distance;
  const double from = std::hypot(x - b.distance * nx, y - b.distance * ny);
  return (from > b.radius) == (b.kind == StockBoundary::Kind::outside);
}

TEST(Arcs, AClippedStretchHoldsThePointsOnTheSideOfTheStock) {  // [N-5]
  using Kind = StockBoundary::Kind;
  for (const StockBoundary& b :
       {StockBoundary{Kind::line, 0.4, 3.5}, StockBoundary{Kind::line, 2.4, -1.0},
        StockBoundary{Kind::outside, 1.0, 4.0, 5.0},
        StockBoundary{Kind::inside, -0.3, 4.0, 5.0},
        StockBoundary{Kind::outside, 0.2, 12.0, 8.0}}) {
    for (double theta = -1.5; theta < 4.7; theta += 0.0317) {
      const Stretch part = clipped(b, theta, {4.9, 5.0});
      for (double r = 4.9005; r < 5.0; r += 0.001) {
        if (std::abs(r - part.from) < 1e-9 || std::abs(r - part.to) < 1e-9) continue;
        EXPECT_EQ(in_stock(b, theta, r), r > part.from && r < part.to)
            << theta << ' ' << r << ' ' << static_cast<int>(b.kind);
      }
    }
  }
}

TEST(Arcs, ABoundaryCrossesAnotherRadiusNextToWhereItCrossesTheCircle) {  // [N-5]
  const StockBoundary line{StockBoundary::Kind::line, 0.0, 3.5};
  EXPECT_NEAR(theta_at_radius(line, std::acos(0.7), 4.9), std::acos(3.5 / 4.9), 1e-14);
  EXPECT_NEAR(theta_at_radius(line, -std::acos(0.7), 4.9), -std::acos(3.5 / 4.9),
              1e-14);
  // It never gets as near as 3.4: then it is followed to where it leaves the circle.
  EXPECT_NEAR(theta_at_radius(line, std::acos(0.7), 3.4), -std::acos(0.7), 1e-14);
  const StockBoundary circle{StockBoundary::Kind::outside, 1.0, 4.0, 5.0};
  const double at_rim = 1.0 + std::acos((25 + 16 - 25) / 40.0);
  const double r = 4.8;
  const double theta = theta_at_radius(circle, at_rim, r);
  EXPECT_NEAR(std::hypot(r * std::sin(theta) - 4 * std::sin(1.0),
                         r * std::cos(theta) - 4 * std::cos(1.0)),
              5.0, 1e-13);
  EXPECT_NEAR(theta, at_rim, 0.1);
}

TEST(Arcs, TheCircleOfATurnAgoBoundsNothingBehind) {  // [N-5]
  // It meets the circle of the cutter at both sides, and lies within it in front only.
  const double feed = 0.2;
  const StockBoundary before{StockBoundary::Kind::outside, -std::numbers::pi / 2, feed,
                             5.0};
  const double apart = std::asin(feed / 2 / 5.0);
  const double end = std::numbers::pi + apart;
  EXPECT_EQ(theta_at_radius(before, end, 5.0 - 2 * feed), end);
  EXPECT_EQ(theta_at_radius(before, -apart, 5.0 - 2 * feed), -apart);
}

TEST(Arcs, AHeightHasTheArcsOfItsLayer) {
  const Arcs arcs{
      {{0.0, 1.0, {{{0.1, 0.2}}}}, {1.0, 2.0, {{{0.3, 0.4}}, {{0.5, 0.6}}}}}};
  EXPECT_EQ(arcs.at(0.5).size(), 1u);
  EXPECT_EQ(arcs.at(1.0).size(), 2u);
  EXPECT_EQ(arcs.at(2.0).size(), 2u);
  EXPECT_EQ(arcs.at(2.1).size(), 0u);
  EXPECT_EQ(arcs.at(-0.1).size(), 0u);
}

}  // namespace trochoid::geometry::arcs_test
