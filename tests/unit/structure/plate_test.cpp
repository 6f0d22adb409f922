#include <trochoid/structure/plate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "difference_plate.h"

namespace trochoid::structure {

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
  // Ritz, finite elements and differences agree on these (spec of the wall, case 01).
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
    const PlateSolution fine(wall, x, 4e-5);
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
  // Spacings h and h/2; the error of differences falls with h^2, so (4 fine -
  // coarse)/3.
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
  const PlateSolution plate(good, 1, 1e-2);
  EXPECT_THROW(static_cast<void>(plate.pressure(1, 1.01)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(plate.pressure(std::nan(""), 1)),
               std::invalid_argument);
  const std::array<double, 1> edge = {1.0};
  EXPECT_THROW(plate.line_load(1, edge, 1, 0.9, 0.8), std::invalid_argument);
}

TEST(Plate, StandsStillAtItsClamps) {  // [B-4]
  const PlateSolution plate(unit_plate(2, 1, 0.3), 0.0, 1e-3);
  EXPECT_TRUE(plate.converged());
  EXPECT_NEAR(under_load(plate, 0, 1), 0, 1e-30);
  EXPECT_NEAR(under_load(plate, 1, 0), 0, 1e-30);
}

}  // namespace trochoid::structure
