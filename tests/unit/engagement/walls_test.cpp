#include "made_program.h"

#include <trochoid/engagement/walls.h>
#include <trochoid/surface/error_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace trochoid::engagement::walls_test {

const stock::Initial block = box({-40, -40, -10}, {40, 40, 0});

/// A cutter of 10 mm that gives way.
Tool slender(std::vector<double> offsets_um) {
  Tool tool = end_mill(10, 2, 30, std::move(offsets_um));
  tool.body = structure::Cantilever{.overhang = 45e-3,
                                    .flute_length = 25e-3,
                                    .shank_diameter = 10e-3,
                                    .flute_diameter = 8e-3,
                                    .youngs_modulus = 2e11};
  return tool;
}

MadeProgram pass(double y) {
  MadeProgram made(1000, 100);
  made.rapid(-50, y, 5).rapid(-50, y, -6).line(50, y, -6);
  return made;
}

std::vector<StepWalls> walls(const MadeProgram& made, const Tool& tool,
                             std::vector<Step>& rows) {
  rows = run(made, tool, block).rows;
  const Job job{made.program, std::span(&tool, 1), block, {}};
  return wall_errors(job, rows, {});
}

/// The row in the middle of the block on a line.
std::size_t middle(std::span<const Step> rows, std::uint32_t line) {
  const auto at = std::ranges::find_if(rows, [&](const Step& s) {
    return s.line == line && s.a_p > 0 && s.place[0] > 0;
  });
  return static_cast<std::size_t>(at - rows.begin());
}

/// What the room surface says of the same wall.
surface::MeanAndExtremes straight(const Tool& tool, geometry::Engagement engagement) {
  const surface::Setting setting{
      .setup = {.cutter = tool.cutter,
                .runout = tool.runout,
                .cut = {.engagement = std::move(engagement),
                        .a_p = 6e-3,
                        .f_z = 0.05e-3}},
      .law = tool.law,
      .bodies = surface::bodies_at(tool.body, std::nullopt, 6e-3)};
  return surface::error_map(setting, {.heights = {0, 1.5e-3, 3e-3, 4.5e-3, 6e-3}})
      .error;
}

TEST(Walls, AStraightWallIsThatOfTheSurface) {  // [N-22]
  for (const bool down : {true, false}) {
    const Tool tool = slender({0, -8});
    std::vector<Step> rows;
    const auto found = walls(pass(down ? 43 : -43), tool, rows);
    const StepWalls at = found[middle(rows, 3)];
    const std::optional<WallError>& wall = down ? at.right : at.left;
    EXPECT_FALSE((down ? at.left : at.right).has_value());
    ASSERT_TRUE(wall.has_value());
    const auto expected = down ? straight(tool, geometry::DownMilling{2e-3})
                               : straight(tool, geometry::UpMilling{2e-3});
    const double span = std::max(std::abs(expected.max), std::abs(expected.min));
    EXPECT_GT(span, 10e-6);  // it does bend
    EXPECT_NEAR(wall->most, expected.max, 0.01 * span);
    EXPECT_NEAR(wall->least, expected.min, 0.01 * span);
    EXPECT_NEAR(wall->mean, expected.mean, 0.01 * span);
  }
}

TEST(Walls, OnlyWallsThatStayCount) {  // [N-21]
  MadeProgram made(1000, 100);  // a slot, then its right wall again, 0.3 mm farther
  made.rapid(-50, 0, 5).rapid(-50, 0, -6).line(50, 0, -6);
  made.rapid(50, 0, 5).rapid(-50, -0.3, 5).rapid(-50, -0.3, -6).line(50, -0.3, -6);
  std::vector<Step> rows;
  const auto found = walls(made, slender({}), rows);
  const StepWalls slot = found[middle(rows, 3)];
  EXPECT_TRUE(slot.left.has_value());
  EXPECT_FALSE(slot.right.has_value());
  const StepWalls finish = found[middle(rows, 7)];
  EXPECT_FALSE(finish.left.has_value());
  ASSERT_TRUE(finish.right.has_value());
  // A thin finish leaves less than the slot.
  EXPECT_LT(std::abs(finish.right->mean), 0.8 * std::abs(slot.left->mean));
}

TEST(Walls, ARigidToolHasNone) {
  std::vector<Step> rows;
  for (const StepWalls& one : walls(pass(43), end_mill(10, 2, 30), rows)) {
    EXPECT_FALSE(one.left.has_value() || one.right.has_value());
  }
}

}  // namespace trochoid::engagement::walls_test
