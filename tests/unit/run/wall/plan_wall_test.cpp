#include <trochoid/base/units.h>
#include <trochoid/run/commands.h>

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "wall_case.h"

namespace trochoid::run::plan_wall_test {

using namespace test;

const std::string expected = "[runout]\neccentricity_mm = 0.004\nangle_deg = 70\n";
const std::string imprint = "[surface]\nmodel = \"imprint\"\n";
/// Few designs and a small map.
const std::string small =
    "[plan]\nheights = [3, 7]\nreadings_per_height = [3, 12]\nspread = [0.8]\n"
    "feed_per_tooth_mm = [0.05, 0.1, 0.2]\nradial_depth_mm = [0.5, 1]\n";

results::PlanWallResult planned(const std::string& text) {
  return plan_wall(case_of(text, cases::Command::plan), {});
}

TEST(PlanWall, ChoosesTheFewestReadingsThatAreEnough) {
  const auto r = planned(cut_tables + cutter_table + expected + imprint + small +
                         "wanted_percent = 200\nwanted_um = 10\n");
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  ASSERT_EQ(r.designs.size(), 4U);
  ASSERT_TRUE(r.chosen.has_value());
  EXPECT_TRUE(r.designs[*r.chosen].enough);
  for (std::size_t i = 0; i < *r.chosen; ++i) {
    EXPECT_FALSE(r.designs[i].enough) << "cheaper and enough";
  }
  EXPECT_TRUE(r.heading.message.starts_with("Measure ")) << r.heading.message;
  EXPECT_EQ(r.noise_from, "assumed");
  EXPECT_EQ(r.cutting.cells.size(), 6U);
}

TEST(PlanWall, SaysHowFarAWishIs) {
  const auto r = planned(cut_tables + cutter_table + expected + imprint + small +
                         "wanted_percent = 0.1\nnoise_um = 2\n");
  ASSERT_TRUE(r.heading.ok);
  EXPECT_FALSE(r.designs[*r.chosen].enough);
  EXPECT_EQ(r.designs[*r.chosen].readings, 84U) << "the largest";
  EXPECT_TRUE(warned(r, "not_enough"));
  EXPECT_DOUBLE_EQ(r.noise, 2e-6);
}

TEST(PlanWall, NamesACutAndAWallThatKeepALimit) {
  const std::string base = cut_tables + cutter_table + wall_table + expected + imprint;
  const auto free = planned(base + small);
  EXPECT_TRUE(warned(free, "no_error_limit"));
  EXPECT_FALSE(free.cutting.best.has_value());
  const double limit = 0.9 * free.cutting.stated.peak;
  const auto r = planned(
      base + small + "largest_error_um = " + std::to_string(limit / unit::um) + "\n");
  ASSERT_TRUE(r.cutting.best.has_value());
  const surface::GridCell& best = r.cutting.cells[*r.cutting.best];
  EXPECT_LE(best.peak, limit);
  for (const surface::GridCell& cell : r.cutting.cells) {
    EXPECT_TRUE(cell.peak > limit || cell.removal_rate <= best.removal_rate);
  }
  ASSERT_TRUE(r.cutting.thinnest.has_value());
  EXPECT_GT(r.cutting.thinnest->thickness.value_or(0.0), *r.cutting.thickness);
}

TEST(PlanWall, LooksAtOtherCutsAndWalls) {
  const auto r =
      planned(cut_tables + cutter_table + wall_table + expected + imprint + small);
  std::size_t as_stated = 0;
  for (const results::ChangedWall& c : r.changes) {
    if ((c.key == "axial_depth_mm" && c.value == 3e-3) ||
        (c.key == "thickness_mm" && c.value == 2e-3)) {
      ++as_stated;
      EXPECT_NEAR(c.told.se_K_tc, r.designs[*r.chosen].told.se_K_tc,
                  1e-6 * c.told.se_K_tc);
    }
  }
  EXPECT_EQ(as_stated, 2U);
  EXPECT_EQ(r.changes.size(), 20U);
  EXPECT_EQ(r.more.size(), 19U);
}

TEST(PlanWall, StartsFromWhatWasMeasured) {
  const results::SurfaceResult made =
      surface(case_of(cut_tables + cutter_table + imprint +
                      "heights_mm = [0.5, 1.0, 1.5, 2.0, 2.5]\n" + expected),
              {});
  const auto file = written("planned.csv", "x_mm,height_mm,error_mm,tooth\n");
  std::ofstream out(file, std::ios::app);
  out.precision(17);
  double noise = 1e-3;
  for (const surface::ErrorRow& row : made.map.rows) {
    for (std::size_t i = 0; i < row.x.size(); ++i) {
      noise = -noise;
      out << row.x[i] / unit::mm << ',' << row.height / unit::mm << ','
          << row.error[i] / unit::mm + noise << ',' << row.tooth[i] + 1 << '\n';
    }
  }
  out.close();
  const auto r = planned(cut_tables + cutter_table + imprint + small +
                         "[[surface_measurement]]\nfile = \"" + file.string() + "\"\n");
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  EXPECT_EQ(r.noise_from, "readings");
  EXPECT_NEAR(r.noise, 1e-6, 0.5e-6);
  EXPECT_EQ(r.measured, 15U);
  ASSERT_TRUE(r.so_far && r.so_far->told);
  EXPECT_NEAR(force::coefficients(r.law)[0], 400e6, 60e6);
  EXPECT_LT(r.more.front().told.se_K_tc, r.so_far->se_K_tc);
  EXPECT_EQ(r.form, surface::PlannedForm::none) << "as the measurement has it";
}

TEST(PlanWall, NeedsCoefficientsAboveZero) {
  std::string text = cut_tables + cutter_table + expected + imprint + small;
  const std::string key = "K_rc_MPa = 200";
  text.replace(text.find(key), key.size(), "K_rc_MPa = 0");
  const auto r = planned(text);
  EXPECT_FALSE(r.heading.ok);
  EXPECT_NE(r.heading.message.find("coefficient above 0"), std::string::npos);
}

TEST(PlanWall, RefusesWhatNoReadingsTell) {
  std::string text = cut_tables + cutter_table + expected + imprint + small;
  const std::string key = "helix_deg = 45";
  text.replace(text.find(key), key.size(), "helix_deg = 0");
  const auto r = planned(text);
  EXPECT_FALSE(r.heading.ok);
  EXPECT_NE(r.heading.message.find("tells the coefficients apart"), std::string::npos)
      << r.heading.message;
}

}  // namespace trochoid::run::plan_wall_test
