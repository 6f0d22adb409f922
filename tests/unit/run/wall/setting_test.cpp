#include <trochoid/base/units.h>
#include <trochoid/run/wall.h>

#include <gtest/gtest.h>

#include "wall_case.h"

namespace trochoid::run::setting_test {

using namespace test;

TEST(WallSetting, IsWhatTheCaseSaysInSi) {
  const cases::Case given = case_of(cut_tables + cutter_table + wall_table + R"(
[surface]
model = "imprint"
load = "concentrated"
feedback = "entry"
phase_deg = 90
probe_diameter_mm = 1
)");
  const surface::Setting setting = wall_setting(given);
  EXPECT_EQ(setting.model, surface::Model::imprint);
  EXPECT_EQ(setting.load, surface::Load::concentrated);
  EXPECT_NEAR(setting.phase, unit::turn / 4, 1e-15);
  EXPECT_EQ(setting.probe_radius, 0.5e-3);
  EXPECT_EQ(setting.setup.cut.a_p, 3e-3);
  EXPECT_EQ(wall_feedback(given), surface::Feedback::entry);
  EXPECT_EQ(wall_position(given), 20e-3);
  const surface::Bodies bodies = setting.bodies(20e-3);
  ASSERT_TRUE(bodies.cutter && bodies.wall);
  EXPECT_EQ(bodies.cutter->shank_diameter, 10e-3);
  EXPECT_EQ(bodies.cutter->youngs_modulus, 206e9);
  EXPECT_EQ(bodies.wall->height, 30e-3);
}

TEST(WallSetting, WhatIsNotThereIsRigid) {
  const cases::Case given = case_of(cut_tables);
  const surface::Bodies bodies = wall_setting(given).bodies(0.0);
  EXPECT_FALSE(bodies.cutter || bodies.wall);
  EXPECT_EQ(wall_position(given), 0.0);
}

TEST(WallSetting, ACutterOfOnePieceIsFlutedAllAlong) {
  const auto body =
      wall_cutter(case_of(cut_tables +
                          "[cutter_body]\noverhang_mm = 83\nyoungs_modulus_GPa = 206\n")
                      .machine);
  ASSERT_TRUE(body);
  EXPECT_EQ(body->flute_length, body->overhang);
}

TEST(MapOptions, AreThoseOfSamplingAndSurface) {
  const surface::MapOptions options = map_options(case_of(cut_tables + wall_table + R"(
[sampling]
samples_per_rev = 90
revolutions = 2
tolerance = 1e-5
[surface]
heights_mm = [0.5, 1.5]
influence_heights_mm = [1]
)"));
  EXPECT_EQ(options.samples_per_turn, 90);
  EXPECT_EQ(options.turns, 2.0);
  EXPECT_EQ(options.tolerance, 1e-5);
  EXPECT_EQ(options.heights, (std::vector<double>{0.5e-3, 1.5e-3}));
  EXPECT_EQ(options.influence_heights, std::vector<double>{1e-3});
  EXPECT_EQ(options.position, 20e-3);
}

TEST(MapOptions, HeightsOfChipsStandInForThoseOfTheWall) {
  const surface::MapOptions options =
      map_options(case_of(cut_tables + "[sampling]\nedge_heights_mm = [1, 2]\n"));
  EXPECT_EQ(options.heights, (std::vector<double>{1e-3, 2e-3}));
}

}  // namespace trochoid::run::setting_test
