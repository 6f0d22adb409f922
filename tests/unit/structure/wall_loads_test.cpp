#include <trochoid/structure/wall_loads.h>

#include <gtest/gtest.h>

#include <stdexcept>

namespace trochoid::structure::wall_loads_test {

namespace {

const Plate square{.length = 40e-3,
                   .height = 40e-3,
                   .thickness = 1e-3,
                   .youngs_modulus = 70e9,
                   .poisson_ratio = 0.3};

}  // namespace

TEST(WallLoads, PressureIsThatOfTheHandbook) {  // [B-11]
  const LoadedWalls all = loaded_walls(square, {.pressure = 5e3, .position = 20e-3});
  ASSERT_EQ(all.walls.size(), 1U);
  const LoadedWall& wall = all.walls[0];
  EXPECT_EQ(wall.load, WallLoad::pressure);
  EXPECT_NEAR(wall.coefficient, 0.00295061, 1e-6);
  EXPECT_EQ(wall.x, 20e-3);
  EXPECT_EQ(wall.y, 40e-3);
  const double D = 70e9 * 1e-9 / (12 * (1 - 0.09));
  EXPECT_NEAR(wall.largest, 0.00295061 * 5e3 * 40e-3 * 40e-3 * 40e-3 * 40e-3 / D, 3e-9);
  EXPECT_EQ(wall.w.size(), all.x.size() * all.y.size());
  EXPECT_EQ(all.x.size(), 21U);
  EXPECT_EQ(wall.w.front(), 0.0);  // at the foot
}

TEST(WallLoads, AnEdgeLoadOnAFreeWallIsABeam) {  // [B-11]
  Plate free = square;
  free.ends = Ends::free;
  free.poisson_ratio = 0;
  const LoadedWalls all =
      loaded_walls(free, {.edge_load = 100, .position = 20e-3, .x = {3e-3}});
  EXPECT_NEAR(all.walls.at(0).coefficient, 1.0 / 3, 1e-8);
  EXPECT_EQ(all.walls[0].x, 3e-3);
}

TEST(WallLoads, ALineLoadIsThatOfTheSolution) {  // [B-11] [B-7]
  const WallLoads loads{
      .line_load = 2e3, .position = 13e-3, .depth = 5e-3, .y = {37e-3, 40e-3}};
  const LoadedWalls all = loaded_walls(square, loads);
  ASSERT_EQ(all.x.size(), 22U);
  EXPECT_EQ(all.x[7], 13e-3);  // between 12 and 14 mm: the position is among them
  const LoadedWall& wall = all.walls.at(0);
  const auto per_N = PlateSolution(square, 13e-3, 2e-4, 5e-3)
                         .line_load(13e-3, loads.y, 13e-3, 35e-3, 40e-3);
  EXPECT_NEAR(wall.w[7 * 2], per_N[0] * 10, 1e-12);
  EXPECT_NEAR(wall.w[7 * 2 + 1], per_N[1] * 10, 1e-12);
  // Towards the middle the wall gives way more than under the load.
  EXPECT_GT(wall.x, 13e-3);
  EXPECT_EQ(wall.y, 40e-3);
  EXPECT_GT(wall.largest, per_N[1] * 10);
}

TEST(WallLoads, WithoutALoadThereIsNothing) {
  EXPECT_TRUE(loaded_walls(square, {.position = 20e-3}).walls.empty());
}

TEST(WallLoads, PointsBesideTheWallAreRefused) {
  EXPECT_THROW(loaded_walls(square, {.pressure = 1, .position = 1e-3, .y = {41e-3}}),
               std::invalid_argument);
}

}  // namespace trochoid::structure::wall_loads_test
