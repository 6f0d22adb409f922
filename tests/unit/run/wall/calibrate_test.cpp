#include <trochoid/base/units.h>
#include <trochoid/run/wall/calibrate.h>
#include <trochoid/run/wall/surface.h>

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "wall_case.h"

namespace trochoid::run {
namespace {

using namespace test;

const std::string imprints = "[surface]\nmodel = \"imprint\"\nheights_mm = ";

/// The imprints that a cut with runout leaves, as a file of readings.
std::string readings_at(const std::string& heights, double factor = 1.0) {
  const results::SurfaceResult made =
      surface(case_of(cut_tables + cutter_table + imprints + heights +
                      "\n[runout]\neccentricity_mm = 0.005\nangle_deg = 70\n"),
              {});
  const auto* const info = testing::UnitTest::GetInstance()->current_test_info();
  const auto file =
      written(std::string(info->name()) + ".csv", "x_mm,height_mm,error_mm,tooth\n");
  std::ofstream out(file, std::ios::app);
  out.precision(17);
  for (const surface::ErrorRow& row : made.map.rows) {
    for (std::size_t i = 0; i < row.x.size(); ++i) {
      out << row.x[i] / unit::mm << ',' << row.height / unit::mm << ','
          << factor * row.error[i] / unit::mm << ',' << row.tooth[i] + 1 << '\n';
    }
  }
  return file.string();
}

/// A calibration from such a file.
inputs::Case calibrating(const std::string& file, const std::string& more = "") {
  return case_of(cut_tables + cutter_table + "[surface]\nmodel = \"imprint\"\n" + more +
                     "\n[[surface_measurement]]\nfile = \"" + file + "\"\n",
                 inputs::Command::calibrate);
}

const std::string heights = "[0.5, 1.0, 1.5, 2.0, 2.5]";

TEST(CalibrateWall, FindsWhatTheWallWasMadeWith) {
  std::vector<std::string> told;
  const results::CalibrateResult r =
      calibrate(calibrating(readings_at(heights)),
                [&](const std::string& what) { told.push_back(what); });
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  EXPECT_TRUE(r.heading.message.starts_with("K_tc = 399.9")) << r.heading.message;
  EXPECT_NE(r.heading.message.find(" MPa from 15 readings; runout 4.99"),
            std::string::npos)
      << r.heading.message;
  // Of this chip, runout drops out of the means but for the turn by epsilon of G-9.
  EXPECT_NEAR(r.calibration.coefficients.K_tc.value, 400e6, 0.1e6);
  EXPECT_NEAR(r.calibration.coefficients.K_rc.value, 200e6, 0.1e6);
  EXPECT_NEAR(r.calibration.runout.eccentricity.value, 5e-6, 1e-8);
  EXPECT_EQ(r.readings.size(), 15U);
  EXPECT_EQ(r.datum.size(), 1U);
  EXPECT_EQ(r.teeth, 3);
  EXPECT_EQ(told, (std::vector<std::string>{"Fitting the coefficients",
                                            "Looking for runout"}));
}

TEST(CalibrateWall, SaysWhatIsKnownWhereHeightsAreTooFew) {
  const results::CalibrateResult r = calibrate(calibrating(readings_at("[1.0]")), {});
  EXPECT_FALSE(r.heading.ok);
  EXPECT_FALSE(r.calibration.ok);
  EXPECT_TRUE(r.heading.message.starts_with("1 means of readings for 2 unknowns"))
      << r.heading.message;
}

TEST(CalibrateWall, WarnsOfReadingsOfZeroAndOfNothingElse) {
  const results::CalibrateResult r =
      calibrate(calibrating(readings_at(heights, 0.0)), {});
  EXPECT_TRUE(r.heading.ok);
  ASSERT_EQ(r.heading.warnings.size(), 1U);
  EXPECT_EQ(r.heading.warnings[0].code, "all_zero");
}

TEST(CalibrateWall, WarnsOfTheWrongSign) {
  const results::CalibrateResult r =
      calibrate(calibrating(readings_at(heights, -1.0)), {});
  EXPECT_TRUE(warned(r, "negative_coefficient"));
  EXPECT_FALSE(warned(r, "all_zero"));
}

TEST(CalibrateWall, WarnsOfARunoutThatWasGivenToo) {
  const std::string file = readings_at(heights);
  EXPECT_FALSE(warned(calibrate(calibrating(file), {}), "runout_not_used"));
  const std::string runout = "[runout]\neccentricity_mm = 0.001\nangle_deg = 10\n";
  EXPECT_TRUE(warned(calibrate(calibrating(file, runout), {}), "runout_not_used"));
}

}  // namespace
}  // namespace trochoid::run
