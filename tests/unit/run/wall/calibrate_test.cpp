#include <trochoid/base/units.h>
#include <trochoid/results/calibrate.h>
#include <trochoid/run/commands.h>

#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "wall_case.h"

namespace trochoid::run::calibrate_test {

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
cases::Case calibrating(const std::string& file, const std::string& more = "") {
  return case_of(cut_tables + cutter_table +
                     "[surface]\nmodel = \"imprint\"\nfeedback = \"none\"\n" + more +
                     "\n[[surface_measurement]]\nform = \"none\"\nfile = \"" + file +
                     "\"\n",
                 cases::Command::calibrate);
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
  EXPECT_EQ(told,
            (std::vector<std::string>{"Fitting the coefficients", "Looking for runout",
                                      "Looking for doubts"}));
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

TEST(CalibrateWall, RefusesReadingsOfTheWrongSign) {
  const results::CalibrateResult r =
      calibrate(calibrating(readings_at(heights, -1.0)), {});
  EXPECT_FALSE(r.heading.ok);
  EXPECT_TRUE(r.heading.message.starts_with("the readings have the wrong sign"))
      << r.heading.message;
  EXPECT_NE(r.heading.message.find("K_tc_MPa = 399.9"), std::string::npos)
      << r.heading.message;
  EXPECT_TRUE(results::answer_of(r).texts.empty());  // no material.toml
}

/// A profile that the cut of `more` leaves around x, as a file: noise of 1 um, moved
/// along x, and with `off` of every 50th reading.
std::string profile_at(const std::string& x, double moved, double off,
                       const std::string& more = "",
                       const std::string& feedback = "none") {
  std::string text = cut_tables + cutter_table + wall_table +
                     "[surface]\nfeedback = \"" + feedback +
                     "\"\nheights_mm = [0.4, 0.8, 1.2, 1.6, 2.0, 2.4, 2.8]\n" +
                     "[sampling]\nsamples_per_rev = 24\nrevolutions = 1\n" + more;
  text.replace(text.find("position_mm = 20"), 16, "position_mm = " + x);
  text.replace(text.find("\"up\""), 4, "\"down\"");
  const results::SurfaceResult made = surface(case_of(text), {});
  const auto* const info = testing::UnitTest::GetInstance()->current_test_info();
  const auto file = written(std::string(info->name()) + x + ".csv", "");
  std::ofstream out(file);
  out << "x_mm,height_mm,error_mm\n";
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 1e-3);
  int count = 0;
  for (const surface::ErrorRow& row : made.map.rows) {
    for (std::size_t i = 0; i < row.x.size(); ++i) {
      out << row.x[i] / unit::mm + moved << ',' << row.height / unit::mm << ','
          << row.error[i] / unit::mm + noise(random) + (++count % 50 == 0 ? off : 0.0)
          << '\n';
    }
  }
  return file.string();
}

cases::Case measuring(const std::string& file, const std::string& x,
                      const std::string& surface_keys = "") {
  std::string text = cut_tables + cutter_table + wall_table + "[surface]\n" +
                     surface_keys + "\n[[surface_measurement]]\nfile = \"" + file +
                     "\"\nform = \"none\"\n";
  text.replace(text.find("position_mm = 20"), 16, "position_mm = " + x);
  text.replace(text.find("\"up\""), 4, "\"down\"");
  return case_of(text, cases::Command::calibrate);
}

TEST(CalibrateWall, NamesReadingsFarOff) {  // [E-26]
  const std::string file = profile_at("30", 0.0, 0.05);
  const results::CalibrateResult r =
      calibrate(measuring(file, "30", "feedback = \"none\""), {});
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  EXPECT_EQ(r.calibration.outliers.size(), 3U);
  EXPECT_TRUE(warned(r, "outliers"));
  const surface::FoundCoefficients& found = r.calibration.coefficients;
  EXPECT_LT(found.K_tc.low, 400e6);
  EXPECT_GT(found.K_tc.high, 400e6);
  const results::CalibrateResult kept =
      calibrate(measuring(file, "30", "feedback = \"none\"\noutliers = \"keep\""), {});
  EXPECT_TRUE(kept.calibration.outliers.empty());
  EXPECT_GT(kept.calibration.coefficients.rms, 2 * found.rms);
}

/// Millimetres read as metres: no model gets so far as to a fit.
TEST(CalibrateWall, NamesWildReadingsBeforeAnyFit) {  // [E-26]
  const std::string file = profile_at("30", 0.0, 40.0);
  const results::CalibrateResult r =
      calibrate(measuring(file, "30", "model = \"quasi_static\""), {});
  EXPECT_EQ(r.calibration.outliers.size(), 3U);
}

TEST(CalibrateWall, DoubtsAnXThatCountsFromTheScan) {
  const std::string file = profile_at("30", -29.9, 0.0);
  EXPECT_TRUE(
      warned(calibrate(measuring(file, "30", "feedback = \"none\""), {}), "origin"));
  const std::string right = profile_at("30", 0.0, 0.0);
  EXPECT_FALSE(
      warned(calibrate(measuring(right, "30", "feedback = \"none\""), {}), "origin"));
}

TEST(CalibrateWall, ARunoutThatFeedbackHidesIsNotGiven) {  // [E-25]
  const std::string runout = "[runout]\neccentricity_mm = 0.005\nangle_deg = 70\n";
  const auto found = [&](const std::string& feedback) {
    const std::string file = profile_at("30", 0.0, 0.0, runout, feedback);
    return calibrate(measuring(file, "30", "feedback = \"none\""), {});
  };
  EXPECT_TRUE(found("none").calibration.runout.ok);
  const results::CalibrateResult hidden = found("regenerative");
  EXPECT_FALSE(hidden.calibration.runout.ok);
  EXPECT_TRUE(hidden.calibration.runout.message.starts_with(
      "the readings follow the feedback of the deflection"))
      << hidden.calibration.runout.message;
}

TEST(CalibrateWall, WarnsOfARunoutThatWasGivenToo) {
  const std::string file = readings_at(heights);
  EXPECT_FALSE(warned(calibrate(calibrating(file), {}), "runout_not_used"));
  const std::string runout = "[runout]\neccentricity_mm = 0.001\nangle_deg = 10\n";
  EXPECT_TRUE(warned(calibrate(calibrating(file, runout), {}), "runout_not_used"));
}

}  // namespace trochoid::run::calibrate_test
