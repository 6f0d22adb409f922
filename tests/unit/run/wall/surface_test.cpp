#include <trochoid/run/wall/surface.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "wall_case.h"

namespace trochoid::run {
namespace {

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
  EXPECT_TRUE(r.heading.message.starts_with("no deflection agrees with the chip"));
  EXPECT_TRUE(r.map.rows.empty());
}

}  // namespace
}  // namespace trochoid::run
