#include <trochoid/run/commands.h>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "wall_case.h"

namespace trochoid::run::surface_test {

using namespace test;

const std::string few = "[sampling]\nsamples_per_rev = 30\n";

TEST(Surface, AnswersWithTheMapAndItsBodies) {
  std::vector<std::string> told;
  const results::SurfaceResult r =
      surface(case_of(cut_tables + cutter_table + wall_table + few +
                      "[surface]\nheights_mm = [0.5, 2.5]\n"),
              [&](const std::string& what) { told.push_back(what); });
  EXPECT_TRUE(r.heading.ok);
  EXPECT_TRUE(r.heading.message.starts_with("The error of the wall is"));
  EXPECT_NE(r.heading.message.find("The force across it reaches "), std::string::npos);
  EXPECT_FALSE(r.heading.case_toml.empty());
  EXPECT_EQ(r.map.rows.size(), 2U);
  EXPECT_TRUE(r.map.shape);
  EXPECT_EQ(r.diameter, 12e-3);
  EXPECT_EQ(r.a_p, 3e-3);
  EXPECT_EQ(r.cutter->overhang, 83e-3);
  EXPECT_EQ(r.wall->thickness, 2e-3);
  EXPECT_EQ(told, (std::vector<std::string>{"Solving the wall", "Cutting"}));
}

TEST(Surface, WarnsWhereNothingBendsOrAPulseIsNoSurface) {
  const auto rigid =
      surface(case_of(cut_tables + few + "[surface]\nmodel = \"quasi_static\"\n"), {});
  EXPECT_TRUE(warned(rigid, "rigid"));
  EXPECT_TRUE(warned(rigid, "quasi_static"));
  EXPECT_FALSE(rigid.map.shape || rigid.cutter || rigid.wall);
}

TEST(Surface, WarnsWhereTheDeflectionIsLarge) {
  const std::string thin = R"([wall]
length_mm = 60
height_mm = 30
thickness_mm = 0.2
youngs_modulus_GPa = 69
poisson_ratio = 0.33
)";
  const auto soft = surface(case_of(cut_tables + thin + few), {});
  EXPECT_TRUE(warned(soft, "thick_deflection"));
  EXPECT_TRUE(warned(soft, "feedback"));
  EXPECT_FALSE(warned(surface(case_of(cut_tables + few), {}), "feedback"));
}

TEST(Surface, SaysWhyThereIsNoSteadyState) {
  const std::string rubber =
      "[cutter_body]\noverhang_mm = 83\nyoungs_modulus_GPa = 0.2\n";
  const results::SurfaceResult r = surface(
      case_of(cut_tables + rubber + few + "[surface]\nfeedback = \"entry\"\n"), {});
  EXPECT_FALSE(r.heading.ok);
  EXPECT_TRUE(r.heading.message.starts_with("no deflection was found that agrees"));
  EXPECT_TRUE(r.map.rows.empty());
}

TEST(Surface, TakesAllPassesAndTellsOfTheLastOne) {
  const std::string heights = "[surface]\nheights_mm = [0.5, 2.5]\n";
  const results::SurfaceResult r =
      surface(case_of(cut_tables + cutter_table + wall_table + few + heights +
                      "[[pass]]\n[[pass]]\nradial_depth_mm = 0.2\n"
                      "feed_per_tooth_mm = 0.1\n[[pass]]\nradial_depth_mm = 0\n"),
              {});
  ASSERT_TRUE(r.heading.ok);
  ASSERT_EQ(r.passes.size(), 3U);
  EXPECT_EQ(r.passes[0].cut.a_e, 1e-3);
  EXPECT_EQ(r.passes[0].cut.f_z, 0.2e-3);
  EXPECT_EQ(r.passes[1].cut.a_e, 0.2e-3);
  EXPECT_EQ(r.passes[1].cut.f_z, 0.1e-3);
  EXPECT_EQ(r.passes[2].cut.a_e, 0.0);
  EXPECT_EQ(r.map.rows.size(), 2U);
  EXPECT_EQ(r.map.error.mean, r.passes[2].error.mean);
  EXPECT_TRUE(r.heading.message.starts_with("The error of the wall after 3 passes is"));
}

TEST(Surface, SaysWhichPassHasNoSteadyState) {
  const std::string rubber =
      "[cutter_body]\noverhang_mm = 83\nyoungs_modulus_GPa = 0.2\n";
  const results::SurfaceResult r =
      surface(case_of(cut_tables + rubber + few +
                      "[surface]\nfeedback = \"entry\"\n[[pass]]\n[[pass]]\n"),
              {});
  EXPECT_FALSE(r.heading.ok);
  EXPECT_TRUE(r.heading.message.starts_with("pass 1: no deflection was found"));
}

TEST(Surface, APassThatHardlyTouchesIsTakenWithoutFeedback) {
  // The last spring pass meets 1 um: no solver settles what it bends.
  const results::SurfaceResult r = surface(case_of(R"(
[tool]
teeth = 3
diameter_mm = 12
helix_deg = 45
[runout]
eccentricity_mm = 0.003
angle_deg = 71
[cut]
engagement = "down"
radial_depth_mm = 0.5
axial_depth_mm = 3
feed_per_tooth_mm = 0.1
spindle_rpm = 1000
[force]
K_tc_MPa = 800
K_rc_MPa = 300
K_ac_MPa = 100
K_te_N_per_mm = 0
K_re_N_per_mm = 0
K_ae_N_per_mm = 0
[cutter_body]
overhang_mm = 83
flute_length_mm = 45
youngs_modulus_GPa = 206
[wall]
length_mm = 60
height_mm = 30
thickness_mm = 4
youngs_modulus_GPa = 69
poisson_ratio = 0.33
[surface]
feedback = "entry"
[[pass]]
[[pass]]
[[pass]]
radial_depth_mm = 0.1
[[pass]]
radial_depth_mm = 0
[[pass]]
radial_depth_mm = 0
)"),
                                           {});
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  EXPECT_EQ(r.map.feedback, surface::Feedback::entry);
  EXPECT_FALSE(r.passes.front().without_feedback);
  EXPECT_TRUE(r.passes.back().without_feedback);
  EXPECT_LT(r.passes.back().F_normal.max, 0.1);
  EXPECT_TRUE(warned(r, "without_feedback"));
}

TEST(Surface, ASpringPassDoesNotCountAsAPartOfNothing) {
  const results::SurfaceResult r = surface(
      case_of(cut_tables + cutter_table + few + "[surface]\nheights_mm = [0.5]\n" +
              "[[pass]]\n[[pass]]\nradial_depth_mm = 0\n"),
      {});
  const double worst =
      std::max(std::abs(r.passes[0].error.max), std::abs(r.passes[0].error.min)) /
      r.passes[0].radial_depth.max;
  ASSERT_EQ(warned(r, "feedback"), worst > 0.01);
  for (const base::Warning& warning : r.heading.warnings) {
    if (warning.code == "feedback") {
      EXPECT_TRUE(warning.message.starts_with(
          fmt::format("The error is {:.2g} % of the radial depth", 100 * worst)));
    }
  }
}

TEST(Surface, ComparesWithTheForceAcrossTheWallAlone) {
  const std::string bends = "[surface]\nheights_mm = [0.5]\nalso_bends = [\"z\"]\n";
  std::string axial = cut_tables;
  axial.replace(axial.find("K_ac_MPa = 0"), 12, "K_ac_MPa = 200");
  const auto plain = surface(
      case_of(axial + cutter_table + few + "[surface]\nheights_mm = [0.5]\n"), {});
  const auto bent = surface(case_of(axial + cutter_table + few + bends), {});
  ASSERT_TRUE(bent.straight);
  EXPECT_FALSE(plain.straight);
  EXPECT_EQ(bent.straight->mean, plain.map.error.mean);
  EXPECT_GT(bent.map.error.mean, plain.map.error.mean + 0.1e-6);
}

TEST(Surface, LoadsTheWallBesideTheCut) {
  const auto loaded = surface(case_of(cut_tables + wall_table +
                                      "pressure_kPa = 3000\nline_load_N_per_mm = 2\n"
                                      "loads_x_mm = [30]\nloads_heights_mm = [30]\n" +
                                      few + "[surface]\nheights_mm = [0.5]\n"),
                              {});
  ASSERT_TRUE(loaded.loads);
  ASSERT_EQ(loaded.loads->walls.size(), 2U);
  EXPECT_EQ(loaded.loads->walls[0].size, 3e6);
  EXPECT_EQ(loaded.loads->walls[1].size, 2e3);
  EXPECT_EQ(loaded.loads->x, std::vector<double>{30e-3});
  // 2 N/mm over the axial depth at the place of the cutter.
  const std::array<double, 1> edge = {30e-3};
  const double per_N = structure::PlateSolution(*loaded.wall, 20e-3, 2e-4, 3e-3)
                           .line_load(30e-3, edge, 20e-3, 27e-3, 30e-3)[0];
  EXPECT_NEAR(loaded.loads->walls[1].w[0], 6 * per_N, 1e-12);
  EXPECT_TRUE(warned(loaded, "thick_deflection"));
  EXPECT_FALSE(surface(case_of(cut_tables + wall_table + few), {}).loads);
}

TEST(Surface, AFreeEndGivesWayMore) {
  const std::string end = few + "[surface]\nheights_mm = [0.5]\n";
  std::string at_end = wall_table;
  at_end.replace(at_end.find("position_mm = 20"), 16, "position_mm = 60");
  const auto clamped = surface(case_of(cut_tables + wall_table + end), {});
  const auto free =
      surface(case_of(cut_tables + at_end + "ends = \"free_end\"\n" + end), {});
  EXPECT_EQ(free.wall->ends, structure::Ends::free_end);
  EXPECT_GT(free.map.rows[0].compliance, 2 * clamped.map.rows[0].compliance);
}

}  // namespace trochoid::run::surface_test
