#include <trochoid/structure/plate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "difference_plate.h"
#include "even_basis.h"

namespace trochoid::structure::plate_test {

namespace {

/// A plate of flexural rigidity 1.
Plate unit_plate(double length, double height, double nu) {
  return {.length = length,
          .height = height,
          .thickness = 1,
          .youngs_modulus = 12 * (1 - nu * nu),
          .poisson_ratio = nu};
}

double under_load(const PlateSolution& plate, double x, double y) {
  const std::array<double, 1> at = {y};
  return plate.influence(x, at, x, at).front();
}

}  // namespace

TEST(Plate, SquareUnderPressure) {  // [B-3] [B-4] [B-6]
  // Ritz, finite elements and finite differences agree on these.
  const PlateSolution plate(unit_plate(1, 1, 0.3), 0.5, 1e-4);
  EXPECT_NEAR(plate.pressure(0.5, 1), 0.00295061, 2e-7);
  EXPECT_NEAR(plate.pressure(0.5, 0.5), 0.00189024, 2e-7);
  const PlateSolution sixth(unit_plate(1, 1, 1.0 / 6), 0.5, 1e-4);
  EXPECT_NEAR(sixth.pressure(0.5, 1), 0.002767, 1e-6);
}

TEST(Plate, LongWallUnderAPointLoadIsTheInfiniteCantileverPlate) {  // [B-4] [B-7]
  // Exact Fourier integral for nu = 0.3; the clamped ends are 10 heights away.
  const PlateSolution plate(unit_plate(20, 1, 0.3), 10, 1e-4);
  EXPECT_TRUE(plate.converged());
  EXPECT_NEAR(under_load(plate, 10, 1), 0.16654, 2e-5);
}

TEST(Plate, TallStripIsAClampedBeamAcross) {  // [B-4]
  // Far from the bottom and the free edge a strip of nu = 0 under pressure is a beam
  // between two clamps: w = q a^4 / (384 D) in the middle.
  const PlateSolution plate(unit_plate(1, 8, 0.0), 0.5, 1e-3);
  EXPECT_NEAR(plate.pressure(0.5, 4) * 384, 1, 1e-4);
}

TEST(Plate, IsSymmetricInLoadAndPoint) {  // [B-7]
  const PlateSolution plate(unit_plate(2, 1, 0.33), 0.5, 1e-3);
  const std::array<double, 3> at = {0.8, 0.93, 1.0};
  const std::array<double, 2> other = {0.5, 0.97};
  const auto G = plate.influence(0.5, at, 0.5, at);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_EQ(G[i * 3 + j], G[j * 3 + i]);
    }
  }
  const auto there = plate.influence(0.5, at, 1.3, other);
  const auto back = plate.influence(1.3, other, 0.5, at);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_NEAR(there[i * 2 + j], back[j * 3 + i], 1e-14);
    }
  }
}

TEST(Plate, IsItsOwnMirrorImage) {  // [B-4]
  const PlateSolution left(unit_plate(2, 1, 0.33), 0.5, 1e-4);
  const PlateSolution right(unit_plate(2, 1, 0.33), 1.5, 1e-4);
  EXPECT_NEAR(under_load(left, 0.5, 1) / under_load(right, 1.5, 1), 1, 1e-10);
}

TEST(Plate, ErrorIsBelowTheTolerance) {  // [B-8]
  const double nu = 0.33;
  for (const auto& [length, x] : {std::pair{2.0, 1.0},
                                  {2.0, 0.5},
                                  {2.0, 0.05},
                                  {7.0, 3.5},
                                  {0.5, 0.25},
                                  {0.3, 0.1}}) {
    const Plate wall = unit_plate(length, 1, nu);
    const PlateSolution fine(wall, x, 1e-4);
    std::vector<double> y;
    for (int i = 0; i < 30; ++i) {
      y.push_back(1 - fine.depth() * i / 32.0);
    }
    const auto exact = fine.influence(x, y, x, y);
    for (const double tolerance : {1e-2, 2e-3, 5e-4}) {
      const PlateSolution plate(wall, x, tolerance);
      EXPECT_TRUE(plate.converged());
      EXPECT_LE(plate.error(), tolerance);
      const auto G = plate.influence(x, y, x, y);
      double error = 0.0;
      for (std::size_t i = 0; i < G.size(); ++i) {
        error = std::max(error, std::abs(G[i] - exact[i]) / exact[0]);
      }
      EXPECT_LE(error, plate.error()) << length << ' ' << x << ' ' << tolerance;
    }
  }
}

TEST(Plate, AgreesWithFiniteDifferences) {  // [B-3] [B-6] [B-7]
  // Spacings h and h/2; the error of differences
  // falls with h^2, so (4 fine - coarse)/3.
  for (const auto& [length, x] : {std::pair{2.0, 1.0}, {2.0, 0.5}, {1.0, 0.25}}) {
    const double nu = 0.33;
    const auto differences = [&](std::size_t cells) {
      const auto n = static_cast<double>(cells);
      const auto columns = static_cast<std::size_t>(std::lround(length * n));
      const auto column = static_cast<std::size_t>(std::lround(x * n));
      const DifferencePlate plate(length, 1, nu, columns, cells);
      Eigen::VectorXd force = Eigen::VectorXd::Zero(plate.size());
      for (std::size_t row = cells - cells / 8; row <= cells; ++row) {  // trapezoid
        const bool end = row == cells || row == cells - cells / 8;
        force[plate.node(column, row)] = (end ? 4.0 : 8.0) / n;
      }
      const Eigen::VectorXd w = plate.solve(force);
      return std::array<double, 3>{w[plate.node(column, cells)],
                                   w[plate.node(column, cells - cells / 8)],
                                   w[plate.node(column / 2, cells / 2)]};
    };
    const auto coarse = differences(32);
    const auto fine = differences(64);
    const PlateSolution plate(unit_plate(length, 1, nu), x, 2e-4);
    const std::array<double, 2> high = {1, 0.875};
    const std::array<double, 1> half = {0.5};
    const auto near = plate.line_load(x, high, x, 0.875, 1);
    const auto far = plate.line_load(x / 2, half, x, 0.875, 1);
    const std::array<double, 3> got = {near[0], near[1], far[0]};
    for (std::size_t i = 0; i < 3; ++i) {
      const double want = (4 * fine[i] - coarse[i]) / 3;
      EXPECT_NEAR(got[i] / want, 1, 2e-3)
          << length << ' ' << x << ' ' << i << ' ' << coarse[i] << ' ' << fine[i];
    }
  }
}

TEST(Plate, LongEdgeUnderALineLoadIsACantileverBeam) {  // [B-6]
  // 1 N/m along the whole free edge, far from the ends: b^3 / 3 D, whatever nu is.
  for (const double nu : {0.0, 0.3}) {
    const double length = 40;
    const RitzSystem ritz(PatchBasis({0, 2, 8, 20, 32, 38, length}, 12, {}),
                          PatchBasis({0, 1}, 8, {.end = false}), nu);
    const auto edge = ritz.y().values(1);
    auto along = ritz.x().means(0, length);
    for (double& one : along) {
      one *= length;
    }
    const auto load = ritz.reduced(along, edge);
    const auto point = ritz.reduced(ritz.x().values(length / 2), edge);
    // What the degree leaves on the patches in the middle.
    EXPECT_NEAR(3 * products(point, load, ritz.size()).front(), 1, 1e-6) << nu;
  }
}

TEST(Plate, OffCentreTheTextbookBasisIsWrong) {  // [B-4] [B-5]
  const double nu = 0.33;
  const PlateSolution middle(unit_plate(2, 1, nu), 1, 1e-3);
  const PlateSolution quarter(unit_plate(2, 1, nu), 0.5, 1e-3);
  const double at_middle = under_load(middle, 1, 1);
  const double at_quarter = under_load(quarter, 0.5, 1);
  // In the middle the even shapes come near, at a quarter they stay half as stiff again
  // or more, however many there are.
  EXPECT_NEAR(even_basis_deflection(2, 1, nu, 14, 1) / at_middle, 1, 0.05);
  double before = 0.0;
  for (const std::size_t terms : {4U, 8U, 14U}) {
    const double ratio = even_basis_deflection(2, 1, nu, terms, 0.5) / at_quarter;
    EXPECT_GT(ratio, before);
    EXPECT_LT(ratio, 0.7) << terms;
    before = ratio;
  }
}

TEST(Plate, ErrorFallsWithTheTolerance) {  // [B-8]
  const Plate wall = unit_plate(2, 1, 0.33);
  const double exact = under_load(PlateSolution(wall, 0.5, 1e-4), 0.5, 1);
  double before = 0.0;
  std::size_t terms = 0;
  for (double tolerance = 1.6e-2; tolerance > 3e-4; tolerance /= 2) {
    const PlateSolution plate(wall, 0.5, tolerance);
    const double w = under_load(plate, 0.5, 1);
    EXPECT_LE(std::abs(exact - w), tolerance * exact);
    EXPECT_GE(w, before);  // from below, and never further away
    EXPECT_GE(plate.terms(), terms);
    before = w;
    terms = plate.terms();
  }
  EXPECT_LT(exact - before, 1e-4 * exact);
}

TEST(Plate, SaysWhenTheToleranceIsNotMet) {  // [B-8]
  const PlateSolution plate(unit_plate(2, 1, 0.33), 0.5, 1e-9);
  EXPECT_FALSE(plate.converged());
  EXPECT_GT(plate.error(), 1e-9);
  EXPECT_LT(plate.error(), 1e-4);  // and yet the best that was found
  EXPECT_NEAR(under_load(plate, 0.5, 1), 0.0525119, 1e-6);
}

TEST(Plate, ServesSeveralLoadsAtOnce) {  // [B-8]
  const Plate wall = unit_plate(2, 1, 0.33);
  const std::array<double, 4> x = {0.3, 1.0, 1.001, 1.7};
  const PlateSolution all(wall, x, 5e-4);
  EXPECT_TRUE(all.converged());
  for (const double at : x) {
    const double alone = under_load(PlateSolution(wall, at, 1e-4), at, 1);
    EXPECT_NEAR(under_load(all, at, 1) / alone, 1, 5e-4) << at;
  }
}

TEST(Plate, IsGoodAsDeepAsAsked) {  // [B-8]
  const Plate wall = unit_plate(2, 1, 0.33);
  const double x = 0.1;
  EXPECT_NEAR(PlateSolution(wall, x, 1e-2).depth(), 0.2, 1e-12);
  const PlateSolution deep(wall, x, 1e-3, 0.5);
  EXPECT_TRUE(deep.converged());
  EXPECT_EQ(deep.depth(), 0.5);
  const PlateSolution fine(wall, x, 2e-4, 0.5);
  for (const double y : {1.0, 0.8, 0.71, 0.6, 0.5}) {
    EXPECT_NEAR(under_load(deep, x, y), under_load(fine, x, y),
                1e-3 * under_load(fine, x, 1));
  }
}

TEST(Plate, HasNoEnd) {  // [B-4]
  // A load near the end of a long wall sees the
  // other end as little as that of a longer.
  const Plate wall = unit_plate(30, 1, 0.33);
  const Plate longer = unit_plate(3000, 1, 0.33);
  EXPECT_NEAR(under_load(PlateSolution(wall, 1, 2e-4), 1, 1) /
                  under_load(PlateSolution(longer, 1, 2e-4), 1, 1),
              1, 4e-4);
}

TEST(Plate, AFreeCornerGivesWayMost) {  // [B-3] [B-4]
  // Conforming finite elements (tests/reference/surface_finite_plate.py), nu = 0.3: a
  // load on the corner of a half-infinite wall, and the same at the other end.
  Plate wall = unit_plate(10, 1, 0.3);
  wall.ends = Ends::free_end;
  EXPECT_NEAR(under_load(PlateSolution(wall, 10, 1e-4), 10, 1), 0.41622, 5e-5);
  wall.ends = Ends::free_start;
  EXPECT_NEAR(under_load(PlateSolution(wall, 0, 1e-4), 0, 1), 0.41622, 5e-5);
  // Far from its ends a wall does not know whether they are free.
  wall.ends = Ends::free;
  EXPECT_NEAR(under_load(PlateSolution(wall, 5, 1e-4), 5, 1), 0.16654, 2e-5);
}

TEST(Plate, AFreeStripIsACantileverBeam) {  // [B-3] [B-4]
  // nu = 0: no curvature across, so the beam of width a is exact for an even edge load;
  // a point load adds what it does within a width.
  Plate strip = unit_plate(0.05, 1, 0.0);
  strip.ends = Ends::free;
  const PlateSolution plate(strip, 0.025, 1e-4);
  EXPECT_NEAR(3 * plate.edge_load(0.025, 1), 1, 1e-9);
  EXPECT_NEAR(8 * plate.pressure(0.01, 1), 1, 1e-9);
  EXPECT_NEAR(under_load(plate, 0.025, 1) * 3 * 0.05, 1, 1e-4);
}

TEST(Plate, AThinnerTopIsABeamOfTwoParts) {  // [B-9]
  // 1 N/m at the end of a beam: integral of s^2/D(s), s from the end.
  Plate strip = unit_plate(0.1, 1, 0.0);
  strip.ends = Ends::free;
  strip.layers = {{0.6, 0.8}, {0.75, 0.5}};
  const PlateSolution plate(strip, 0.05, 1e-3);
  const auto part = [](double from, double to, double t) {
    return (to * to * to - from * from * from) / (3 * t * t * t);
  };
  EXPECT_NEAR(plate.edge_load(0.05, 1),
              part(0, 0.25, 0.5) + part(0.25, 0.4, 0.8) + part(0.4, 1, 1), 1e-9);
}

TEST(Plate, HasTheThicknessOfItsLayers) {  // [B-9]
  Plate wall = unit_plate(1, 1, 0.3);
  EXPECT_EQ(thickness_at(wall, 0.9), 1);
  wall.layers = {{0.5, 0.8}, {0.8, 0.6}};
  EXPECT_EQ(thickness_at(wall, 0.4), 1);
  EXPECT_EQ(thickness_at(wall, 0.5), 0.8);
  EXPECT_EQ(thickness_at(wall, 1.0), 0.6);
}

TEST(Plate, ACoupleIsTheSlopeOfTheInfluence) {  // [B-10]
  Plate wall = unit_plate(2, 1, 0.33);
  wall.ends = Ends::free_start;
  wall.layers = {{0.7, 0.5}};
  const PlateSolution plate(wall, 0.5, 1e-4, 0.3);
  const std::array<double, 2> seen = {0.9, 1.0};
  const std::array<double, 1> at = {0.9};
  const double d = 1e-4;
  const std::array<double, 2> beside = {0.9 + d, 0.9 - d};
  const auto G = plate.influence(0.5, seen, 0.5, beside);
  const auto G_y = plate.couple({0.5, seen}, {0.5, at}, Along::y);
  const auto right = plate.influence(0.5, seen, 0.5 + d, at);
  const auto left = plate.influence(0.5, seen, 0.5 - d, at);
  const auto G_x = plate.couple({0.5, seen}, {0.5, at}, Along::x);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(G_y[i], (G[2 * i] - G[2 * i + 1]) / (2 * d), 1e-4);
    EXPECT_NEAR(G_x[i], (right[i] - left[i]) / (2 * d), 1e-4);
  }
  // Finite elements; the slope of r^2 ln r comes slowly.
  EXPECT_NEAR(G_y[0], 0.55517, 2e-4);
  EXPECT_NEAR(G_x[1], -0.098968, 5e-5);
}

TEST(Plate, RefusesWhatIsNoPlate) {  // [B-3]
  const Plate good = unit_plate(2, 1, 0.3);
  for (double Plate::*field :
       {&Plate::length, &Plate::height, &Plate::thickness, &Plate::youngs_modulus}) {
    for (const double bad : {0.0, -1.0, std::nan("")}) {
      Plate plate = good;
      plate.*field = bad;
      EXPECT_THROW(PlateSolution(plate, 0.1, 1e-2), std::invalid_argument);
    }
  }
  EXPECT_THROW(PlateSolution(good, -0.1, 1e-2), std::invalid_argument);
  EXPECT_THROW(PlateSolution(good, 2.1, 1e-2), std::invalid_argument);
  for (const std::vector<Layer>& bad : {std::vector<Layer>{{0.0, 1.0}},
                                        {{1.0, 1.0}},
                                        {{0.5, 0.0}},
                                        {{0.5, 1}, {0.4, 1}}}) {
    Plate plate = good;
    plate.layers = bad;
    EXPECT_THROW(PlateSolution(plate, 0.1, 1e-2), std::invalid_argument);
  }
  const PlateSolution plate(good, 1, 1e-2);
  EXPECT_THROW(static_cast<void>(plate.pressure(1, 1.01)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(plate.pressure(std::nan(""), 1)),
               std::invalid_argument);
  const std::array<double, 1> edge = {1.0};
  EXPECT_THROW(plate.line_load(1, edge, 1, 0.9, 0.8), std::invalid_argument);
}

TEST(Plate, StandsStillAtItsClamps) {  // [B-4]
  const PlateSolution plate(unit_plate(2, 1, 0.3), 0.0, 1e-3);
  EXPECT_TRUE(plate.converged());  // as if loaded a twentieth away
  EXPECT_NEAR(under_load(plate, 0, 1), 0, 1e-30);
  EXPECT_NEAR(under_load(plate, 1, 0), 0, 1e-30);
}

}  // namespace trochoid::structure::plate_test
