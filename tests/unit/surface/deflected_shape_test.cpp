#include "made_wall.h"

#include <trochoid/surface/error_map.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace trochoid::surface::deflected_shape_test {

ErrorMap map_of(BodiesAt bodies, Load load, bool down = false) {
  Setting s = made_setting(Model::envelope, made_cut(down), std::move(bodies));
  s.law = law(400e6, 200e6, 4e3, 2e3);
  s.load = load;
  return error_map(
      s, {.samples_per_turn = 90, .heights = {0.0, 1.5e-3, 3e-3}, .position = 20e-3});
}

/// At a height that the shape has.
std::size_t index_at(const DeflectedShape& shape, double height) {
  const auto at = std::find_if(shape.heights.begin(), shape.heights.end(),
                               [&](double h) { return std::abs(h - height) < 1e-12; });
  EXPECT_NE(at, shape.heights.end()) << height;
  return static_cast<std::size_t>(at - shape.heights.begin());
}

TEST(DeflectedShape, OfBothAddsUpToTheDeflectionUnderEitherLoad) {  // [E-5] [E-6]
  for (const Load load : {Load::distributed, Load::concentrated}) {
    for (const bool down : {true, false}) {
      const ErrorMap map = map_of(with_wall(), load, down);
      ASSERT_TRUE(map.shape);
      const auto peak =
          std::find_if(map.forces.begin(), map.forces.end(),
                       [&](const ForceSample& f) { return f.phi == map.shape->phi; });
      ASSERT_NE(peak, map.forces.end());
      // The first of the peaks that are equal but for rounding, as those of equal teeth.
      constexpr double rounding = 1e-9;
      const double most = std::abs(peak->F_y);
      for (const ForceSample& f : map.forces) {
        if (f.phi < peak->phi) {
          EXPECT_LT(std::abs(f.F_y), (1 - rounding) * most);
        }
        EXPECT_LE(std::abs(f.F_y), (1 + rounding) * most);
      }
      EXPECT_NEAR(map.shape->F_normal, peak->F_normal, 1e-9);
      for (const ErrorRow& row : map.rows) {
        const std::size_t i = index_at(*map.shape, row.height);
        const double both = map.shape->cutter[i] + map.shape->wall[i];
        const double deflection =
            row.deflection[static_cast<std::size_t>(peak - map.forces.begin())];
        EXPECT_NEAR(both, deflection, 1e-9 * std::abs(deflection)) << row.height;
        EXPECT_GT(std::abs(deflection), 1e-7);
      }
    }
  }
}

TEST(DeflectedShape, IsNothingWhereTheBodiesAreHeldOrDoNotReach) {
  for (const Load load : {Load::distributed, Load::concentrated}) {
    const DeflectedShape shape = *map_of(with_wall(), load).shape;
    const std::vector<double>& height = shape.heights;
    EXPECT_NEAR(height.front(), -27e-3, 1e-12);
    EXPECT_NEAR(height.back(), 83e-3, 1e-12);
    EXPECT_TRUE(std::is_sorted(height.begin(), height.end()));
    EXPECT_NEAR(shape.cutter.back(), 0.0, 1e-18);
    EXPECT_NEAR(shape.wall.front(), 0.0, 1e-18);
    for (std::size_t i = 0; i < height.size(); ++i) {
      if (height[i] < -1e-12) {
        EXPECT_EQ(shape.cutter[i], 0.0);
      }
      if (height[i] > 3e-3 + 1e-12) {
        EXPECT_EQ(shape.wall[i], 0.0);
      }
    }
  }
}

TEST(DeflectedShape, BeginsAtTheFootOfAnyWall) {
  // Wall and axial depth where the height of the foot is not 0 to the last bit.
  MadeCut cut = made_cut();
  cut.cut.a_p = 2e-3;
  const structure::Plate plate{60e-3, 20e-3, 2e-3, 69e9, 0.33};
  Setting s = made_setting(Model::imprint, cut, bodies_at({}, plate, 2e-3));
  s.law = law(400e6, 200e6);
  for (const Load load : {Load::distributed, Load::concentrated}) {
    s.load = load;
    const ErrorMap map = error_map(s, {.heights = {1e-3}, .position = 20e-3});
    EXPECT_NEAR(map.shape->heights.front(), -18e-3, 1e-12);
    EXPECT_NEAR(map.shape->wall.front(), 0.0, 1e-18);
  }
}

TEST(DeflectedShape, IsToldOfOneBodyAloneAndNotOfNone) {
  const auto wall_only = [](double x) { return Bodies{.wall = with_wall()(x).wall}; };
  const auto one = map_of(wall_only, Load::distributed).shape;
  ASSERT_TRUE(one);
  EXPECT_NEAR(one->heights.back(), 3e-3, 1e-12);
  for (const double u : one->cutter) {
    EXPECT_EQ(u, 0.0);
  }
  EXPECT_FALSE(map_of(rigid(), Load::distributed).shape);
}

TEST(BodiesAt, SolvesTheWallWhereItIsAsked) {
  const structure::Plate plate{60e-3, 30e-3, 2e-3, 69e9, 0.33};
  const BodiesAt bodies = bodies_at(made_cutter(), plate, 3e-3);
  const Bodies here = bodies(20e-3);
  ASSERT_TRUE(here.cutter && here.wall);
  EXPECT_EQ(here.cutter->overhang, 83e-3);
  EXPECT_EQ(here.wall->height, 30e-3);
  EXPECT_EQ(here.wall->length, 60e-3);
  const std::array top = {30e-3};
  const structure::PlateSolution solved(plate, 20e-3, 2e-4, 3e-3);
  EXPECT_EQ(here.wall->plate->influence(20e-3, top, 20e-3, top),
            solved.influence(20e-3, top, 20e-3, top));
  const Bodies nothing = bodies_at({}, {}, 3e-3)(20e-3);
  EXPECT_FALSE(nothing.cutter || nothing.wall);
}

}  // namespace trochoid::surface::deflected_shape_test
