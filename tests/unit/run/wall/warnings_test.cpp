#include <trochoid/run/wall.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "wall_case.h"

namespace trochoid::run::warnings_test {

using namespace test;

using base::Estimate;

Estimate estimate(double value, double se) {
  return {value, se, value - 2 * se, value + 2 * se};
}

const cases::Case& given(const std::string& feedback = "none") {
  static cases::Case read;
  read = case_of(cut_tables + cutter_table + wall_table +
                 "[surface]\nmodel = \"envelope\"\nfeedback = \"" + feedback + "\"\n");
  return read;
}

/// A good calibration of means over three teeth, without runout.
surface::Calibration sound() {
  surface::Calibration c;
  c.ok = true;
  c.models.nominal = {{.readings = {0, 1, 2}}, {.readings = {3, 4, 5}}};
  surface::CoefficientFit fit{.model = surface::Model::envelope,
                              .ok = true,
                              .K_tc = estimate(800e6, 10e6),
                              .K_rc = estimate(300e6, 10e6)};
  c.models.fits = {fit};
  c.coefficients = {.K_tc = fit.K_tc, .K_rc = fit.K_rc};
  return c;
}

std::vector<base::Warning> warnings_of(const cases::Case& read,
                                       const surface::Calibration& c,
                                       double error = 1e-6) {
  const std::vector<surface::Reading> readings = {{.error = error}, {.error = -error}};
  std::vector<base::Warning> warnings;
  add_calibration_warnings(read, readings, c, warnings);
  return warnings;
}

std::string message_of(const std::vector<base::Warning>& warnings,
                       const std::string& code) {
  const auto found = std::find_if(warnings.begin(), warnings.end(),
                                  [&](const auto& w) { return w.code == code; });
  return found == warnings.end() ? "none" : found->message;
}

TEST(WallWarnings, AreNoneOfASoundCalibration) {
  EXPECT_TRUE(warnings_of(given(), sound()).empty());
}

TEST(WallWarnings, TellOfPoorlyKnownCoefficients) {
  surface::Calibration c = sound();
  c.coefficients.K_rc = estimate(300e6, 90e6);
  EXPECT_TRUE(message_of(warnings_of(given(), c), "poorly_known")
                  .starts_with("K_rc_MPa is known to +- 60 % only"));
  c.coefficients.K_tc.se = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message_of(warnings_of(given(), c), "no_spare_readings"), "none");
}

TEST(WallWarnings, TellWhereTheMeansAreNone) {
  surface::Calibration c = sound();
  c.models.nominal[1].whole = false;
  EXPECT_TRUE(message_of(warnings_of(given(), c), "uneven_readings")
                  .starts_with("1 of 2 means"));
  c.models.nominal = {{.readings = {0}}, {.readings = {1}}};
  EXPECT_NE(message_of(warnings_of(given(), c), "single_readings"), "none");
}

TEST(WallWarnings, TellWhereTheModelMatters) {
  surface::Calibration c = sound();
  surface::CoefficientFit imprint = c.models.fits.front();
  imprint.model = surface::Model::imprint;
  imprint.K_tc = estimate(560e6, 10e6);
  c.models.fits.push_back(imprint);
  const std::string said = message_of(warnings_of(given(), c), "answers_differ");
  EXPECT_TRUE(said.starts_with("Read as imprint, ")) << said;
  EXPECT_NE(said.find("springs back"), std::string::npos) << said;
}

TEST(WallWarnings, SayWhichFitCountsWhereThereIsRunout) {
  surface::Calibration c = sound();
  c.runout = {.ok = true, .eccentricity = estimate(1e-6, 0.6e-6)};
  EXPECT_NE(message_of(warnings_of(given(), c), "no_runout"), "none");
  c.runout.eccentricity = estimate(4e-6, 0.1e-6);
  c.runout_seen = true;
  EXPECT_TRUE(message_of(warnings_of(given("entry"), c), "runout_in_mean")
                  .starts_with("The answer with feedback is one of means"));
  c.with_runout = true;
  const auto joint = warnings_of(given(), c, 0.1e-3);
  EXPECT_TRUE(
      message_of(joint, "runout_in_mean").ends_with("fitted together with it."));
  EXPECT_TRUE(message_of(joint, "feedback").starts_with("The deflection is large"));
}

TEST(WallWarnings, MeasureTheDeflectionByThicknessAndDepth) {
  std::vector<base::Warning> warnings;
  add_bending_warnings(given(), 5e-6, 1e-3, warnings);
  EXPECT_TRUE(warnings.empty());
  add_bending_warnings(given(), 1.1e-3, 1e-3, warnings);
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_EQ(warnings[0].code, "thick_deflection");
  EXPECT_EQ(warnings[1].code, "feedback");
  warnings.clear();
  add_bending_warnings(given(), 0.5e-3, 1e-3, warnings);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(warnings[0].message.starts_with("The error is 50 % of the radial depth"));
  warnings.clear();
  add_bending_warnings(given("entry"), 0.1e-3, 1e-3, warnings);
  EXPECT_TRUE(warnings.empty());
}

}  // namespace trochoid::run::warnings_test
