#include <trochoid/run/identify.h>

#include "../identification/sound_fit.h"

#include <trochoid/base/units.h>

#include <gtest/gtest.h>

namespace trochoid::run::fit_warnings_test {

using identification::Fit;

cases::Case given() {
  cases::Case out;
  out.setup.cutter.pitch = geometry::equal_pitch(2);
  out.setup.cut.f_z = 0.04 * unit::mm;
  return out;
}

Fit sound() {
  Fit fit = identification::test::sound_fit();
  fit.chip.model = chip::Model::trochoidal;
  fit.freedom = 100;
  return fit;
}

std::vector<base::Warning> warnings(const Fit& fit, const cases::Case& c = given(),
                                    std::vector<Fit> others = {}) {
  others.push_back(fit);
  std::vector<base::Warning> out;
  add_fit_warnings(c, others, fit, out);
  return out;
}

/// The one code that a fit is warned of.
std::string code(const Fit& fit, const cases::Case& c = given(),
                 std::vector<Fit> others = {}) {
  const auto all = warnings(fit, c, std::move(others));
  EXPECT_EQ(all.size(), 1U);
  return all.empty() ? "" : all.front().code;
}

TEST(FitWarnings, AreNoneForASoundFit) {
  EXPECT_TRUE(warnings(sound()).empty());
}

TEST(FitWarnings, SayThatResidualsAreCorrelated) {
  Fit fit = sound();
  fit.residual_correlation = 0.8;
  fit.widening = 3.0;
  EXPECT_EQ(code(fit), "correlated_residuals");
  EXPECT_NE(warnings(fit)[0].message.find("3.0 times wider"), std::string::npos)
      << warnings(fit)[0].message;
}

TEST(FitWarnings, SayWhatCannotBeFound) {
  Fit fit = sound();
  fit.unidentifiable = {{"K_te_N_per_mm", "the feed does not change"}};
  EXPECT_EQ(code(fit), "not_identifiable");
  EXPECT_EQ(warnings(fit)[0].message, "K_te_N_per_mm: the feed does not change");
}

TEST(FitWarnings, SayWhichCoefficientNoCutHas) {
  Fit fit = sound();
  fit.coefficients[1] = base::Estimate{-1e9, 1e7, -1.02e9, -0.98e9};
  fit.coefficients[2] = base::Estimate{-1e8, 1e7, -1.2e8, -0.8e8};
  EXPECT_EQ(code(fit), "negative_coefficient");
  EXPECT_EQ(warnings(fit)[0].message.find("K_rc_MPa came out negative"), 0U)
      << "the axial force may pull either way: " << warnings(fit)[0].message;
}

TEST(ReasonsForCare, AreFewWordsForEachDoubt) {
  const std::vector<base::Warning> warnings = {{"part_used", "half of it"},
                                               {"axial_sign", "K_ac is negative"},
                                               {"axial_sign", "again"},
                                               {"poor_fit", "30 %"}};
  EXPECT_EQ(reasons_for_care(warnings),
            (std::vector<std::string>{"z may be reversed",
                                      "much of the force is not explained"}));
  EXPECT_TRUE(reasons_for_care({}).empty());
}

TEST(FitWarnings, SayThatZMayBeReversed) {
  Fit fit = sound();
  fit.coefficients[2] = base::Estimate{-1e8, 1e7, -1.2e8, -0.8e8};
  EXPECT_EQ(code(fit), "axial_sign");
}

TEST(FitWarnings, SayThatNoMaterialIsThatHard) {
  Fit fit = sound();
  fit.coefficients[0] = base::Estimate{2.6e12, 1e9, 2.5e12, 2.7e12};
  EXPECT_EQ(code(fit), "implausible");
  EXPECT_NE(warnings(fit)[0].message.find("N read as kN"), std::string::npos);
  fit.coefficients[0] = base::Estimate{2.6e6, 1e4, 2.5e6, 2.7e6};
  EXPECT_NE(warnings(fit)[0].message.find("kN read as N"), std::string::npos);
}

TEST(FitWarnings, SayWhatTheBandLeavesOut) {
  Fit fit = sound();
  fit.unexplained = {.in_band = 0.1, .all = 0.4, .outside = 0.35};
  fit.options.band_harmonics = 4;
  EXPECT_EQ(code(fit), "outside_the_band");
  EXPECT_NE(warnings(fit)[0].message.find("first 4 harmonics"), std::string::npos);
}

TEST(FitWarnings, SayThatMuchIsLeft) {
  Fit fit = sound();
  fit.unexplained = {.in_band = 0.25, .all = 0.25};
  EXPECT_TRUE(warnings(fit).empty()) << "white noise is no reason to doubt";
  fit.residual_correlation = 0.55;
  fit.widening = 2.0;
  const auto all = warnings(fit);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[1].code, "poor_fit");
  EXPECT_NE(all[1].message.find("band_harmonics = 2"), std::string::npos);
}

TEST(FitWarnings, SayThatEquationsAreFew) {
  Fit fit = sound();
  fit.freedom = 4;
  EXPECT_EQ(code(fit), "few_equations");
}

TEST(FitWarnings, SayThatALesserModelFitsBetter) {
  Fit other = sound();
  other.chip.model = chip::Model::feed;
  other.rms = 9.0;
  EXPECT_EQ(code(sound(), given(), {other}), "other_model_fits_better");
  other.ok = false;
  other.message = "too few samples";
  EXPECT_EQ(code(sound(), given(), {other}), "no_fit");
  other.chip.model = chip::Model::trochoidal;
  Fit lesser = sound();
  lesser.chip.model = chip::Model::feed;
  const auto all = warnings(lesser, given(), {other});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all.front().code, "no_exact_fit");
  EXPECT_EQ(reasons_for_care(all).size(), 1U);
}

TEST(FitWarnings, SayThatAToothMayIdle) {
  Fit fit = sound();
  fit.runout.radial_offsets = {0.0, -50e-6};
  EXPECT_EQ(code(fit), "runout_above_feed");
  fit.chip.model = chip::Model::none;
  EXPECT_TRUE(warnings(fit).empty()) << "the model knows no runout";
}

TEST(FitWarnings, SayThatARunoutIsTooLargeForItsTool) {
  cases::Case coarse = given();
  coarse.setup.cut.f_z = 0.5e-3;
  coarse.setup.cutter.profile.D = 8e-3;
  Fit fit = sound();
  fit.runout.radial_offsets = {0.0, -100e-6};
  const auto all = warnings(fit, coarse);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all.front().code, "large_runout");
  EXPECT_EQ(reasons_for_care(all).size(), 1U);
  fit.runout.radial_offsets = {0.0, -70e-6};
  EXPECT_TRUE(warnings(fit, coarse).empty());
}

TEST(FitWarnings, SayThatTheRunoutIsKnownToOneSideOnly) {
  Fit fit = sound();
  fit.on_edge = {"radial_offsets_mm[2]"};
  EXPECT_EQ(code(fit), "runout_on_edge");
}

}  // namespace trochoid::run::fit_warnings_test
