#include "case_text.h"

#include <trochoid/base/units.h>

#include <gtest/gtest.h>

namespace trochoid::cases::case_wall_plan_test {

using test::CaseFolder;

/// A wall that is about to be cut, with what is expected of it.
const std::string wall = R"([tool]
shape = "cylinder"
teeth = 3
diameter_mm = 12
helix_deg = 45
[cut]
engagement = "down"
radial_depth_mm = 1
axial_depth_mm = 3
feed_per_tooth_mm = 0.2
spindle_rpm = 1000
[cutter_body]
overhang_mm = 83
youngs_modulus_GPa = 206
)" + test::force;

TEST(CaseWallPlan, IsWhatACaseWithASurfaceShows) {
  const CaseFolder folder;
  const Case c = folder.read(wall + "[surface]\n", Command::plan);
  EXPECT_EQ(c.plan.of, PlanOf::wall);
  ASSERT_EQ(c.plan.feeds.size(), 15U);
  EXPECT_DOUBLE_EQ(c.plan.feeds.front(), 0.05 * unit::mm);
  EXPECT_DOUBLE_EQ(c.plan.feeds[6], 0.2 * unit::mm) << "as stated";
  EXPECT_DOUBLE_EQ(c.plan.radial_depths.back(), 2 * unit::mm);
  EXPECT_EQ(c.plan.wall.per_height, (std::vector<double>{3, 12, 24, 48, 96}));
  EXPECT_EQ(c.plan.wall.form, surface::PlannedForm::offset);
  EXPECT_EQ(c.plan.wall.wanted, 10.0);
  EXPECT_DOUBLE_EQ(*c.plan.wall.wanted_runout, 1e-6);
  EXPECT_FALSE(c.plan.wall.noise || c.plan.wall.largest_error);
  EXPECT_EQ(folder.read(wall, Command::plan).plan.of, PlanOf::forces);
  EXPECT_EQ(
      folder.read(wall + "[surface]\n[plan]\nof = \"forces\"\n", Command::plan).plan.of,
      PlanOf::forces);
  EXPECT_EQ(folder.read(wall + "[plan]\nof = \"wall\"\n", Command::plan).plan.of,
            PlanOf::wall);
}

TEST(CaseWallPlan, IsUnderstoodFromWhatItWrites) {
  const CaseFolder folder;
  const Case c = folder.read(
      wall + "[surface]\n[plan]\nlargest_error_um = 40\nlimited = \"mean\"\n",
      Command::plan);
  EXPECT_EQ(folder.problems(c.as_understood, Command::plan), "") << c.as_understood;
  EXPECT_EQ(c.as_understood.find("samples_per_rev = 360"), std::string::npos);
  const Case again = folder.read(c.as_understood, Command::plan);
  EXPECT_EQ(again.as_understood, c.as_understood);
  EXPECT_EQ(again.plan.wall.limited, LimitedError::mean);
  EXPECT_DOUBLE_EQ(*again.plan.wall.largest_error, 40e-6);
}

TEST(CaseWallPlan, TakesEveryKey) {
  const CaseFolder folder;
  const WallPlan p = folder
                         .read(wall + R"([plan]
of = "wall"
heights = [4, 8]
readings_per_height = [6]
spread = [0.7]
noise_um = 2
form = "curvature"
wanted_percent = 5
wanted_um = 0.5
)",
                               Command::plan)
                         .plan.wall;
  EXPECT_EQ(p.heights, (std::vector<double>{4, 8}));
  EXPECT_EQ(p.per_height, std::vector<double>{6});
  EXPECT_EQ(p.spreads, std::vector<double>{0.7});
  EXPECT_DOUBLE_EQ(*p.noise, 2e-6);
  EXPECT_EQ(p.form, surface::PlannedForm::curvature);
  EXPECT_EQ(p.wanted, 5.0);
  EXPECT_DOUBLE_EQ(*p.wanted_runout, 0.5e-6);
}

TEST(CaseWallPlan, RefusesWhatBelongsToForces) {
  const CaseFolder folder;
  const auto says = [&](const std::string& text, const std::string& part) {
    const std::string problems = folder.problems(wall + text, Command::plan);
    EXPECT_NE(problems.find(part), std::string::npos) << problems;
  };
  says("[surface]\n[plan]\nturns = 3\n",
       "plan.turns: has no meaning for of = \"wall\", which this case shows; say of = "
       "\"forces\" if that is meant");
  says("[plan]\nnoise_um = 3\n", "plan.noise_um: has no meaning for of = \"forces\"");
  says("[plan]\nof = \"wall\"\nmax_force_N = 3\n", "has no meaning for of = \"wall\"");
  says("[plan]\nof = \"wall\"\nheights = [2.5]\n",
       "plan.heights entry 1 = 2.5: not a whole number");
  says("[plan]\nof = \"wall\"\nradial_depth_mm = [1, 1]\n",
       "plan.radial_depth_mm: not ascending");
}

}  // namespace trochoid::cases::case_wall_plan_test
