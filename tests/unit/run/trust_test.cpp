#include <gtest/gtest.h>
#include <trochoid/base/units.h>
#include <trochoid/force/forces.h>
#include <trochoid/run/fit_answer.h>
#include <trochoid/run/fits_table.h>
#include <trochoid/run/material.h>
#include <trochoid/run/rounded.h>
#include <trochoid/run/trust.h>

#include <sstream>

namespace trochoid::run {
namespace {

using identification::Estimate;
using identification::Fit;

TEST(Rounded, ValuesHaveTheDigitsOfTheirError) {
  EXPECT_EQ(with_error(2596.31, 57.2), "2596 +- 57");
  EXPECT_EQ(with_error(0.17729, 2.94), "0.2 +- 2.9");
  EXPECT_EQ(with_error(905.65, 1478.0), "900 +- 1500");
  EXPECT_EQ(with_error(-7.9012, 0.196), "-7.90 +- 0.20");
  EXPECT_EQ(with_error(1.23456, 0.0996), "1.23 +- 0.10");
  EXPECT_EQ(with_error(107390.0, 145000.0), "110000 +- 150000");
  EXPECT_EQ(with_error(-1e-9, 0.02), "0.000 +- 0.020");
  EXPECT_EQ(with_error(-12.0, 300.0), "-10 +- 300");
  EXPECT_EQ(with_error(-3.0, 300.0), "0 +- 300");
  EXPECT_EQ(with_error(37.123456, 0.0), "37.123");
}

TEST(Rounded, AbsurdPartsAreNotKnown) {
  EXPECT_EQ(percent(0.4), "40 %");
  EXPECT_EQ(percent(0.0123), "1.2 %");
  EXPECT_EQ(percent(9.62), "not known");
  EXPECT_EQ(percent(std::stod("nan")), "not known");
}

Fit sound_fit() {
  Fit fit;
  fit.ok = true;
  fit.law = force::LinearEdge{2600e6, 1500e6, 330e6, 7e3, 3e3, 1e3};
  for (const double K : force::coefficients(fit.law)) {
    fit.coefficients.emplace_back(Estimate{K, 0.01 * K, 0.98 * K, 1.02 * K});
  }
  fit.runout.radial_offsets = {0.0, -8e-6};
  fit.radial_offsets_se = {std::nullopt, 1e-7};
  fit.phase = {0.1};
  fit.phase_se = {0.001};
  fit.interval_factor = 2.0;
  fit.rms = 12.0;
  fit.unexplained = {.in_band = 0.1, .all = 0.1};
  return fit;
}

TEST(Trust, NothingSpeaksAgainstASoundFit) {
  EXPECT_TRUE(reasons_against(sound_fit()).empty());
}

TEST(Trust, HalfOfTheForceUnexplainedIsTooMuchUnlessItIsNoise) {  // [I-9]
  Fit fit = sound_fit();
  fit.unexplained.in_band = 0.51;
  EXPECT_TRUE(reasons_against(fit).empty()) << "white noise widens the intervals";
  fit.residual_correlation = 0.9;
  ASSERT_EQ(reasons_against(fit).size(), 1U);
  EXPECT_NE(reasons_against(fit)[0].find("51 %"), std::string::npos);
  fit.unexplained.in_band = 0.49;
  EXPECT_TRUE(reasons_against(fit).empty());
  fit.residual_correlation = 0.0;
  fit.options.band_harmonics = 2;
  fit.unexplained.in_band = 0.51;
  EXPECT_EQ(reasons_against(fit).size(), 1U);
}

TEST(Trust, NegativeCuttingCoefficientsAreWrong) {
  for (const std::size_t q : {0U, 1U}) {
    Fit fit = sound_fit();
    fit.coefficients[q] = Estimate{-300e6, 10e6, -320e6, -280e6};
    EXPECT_EQ(reasons_against(fit).size(), 1U) << q;
    fit.coefficients[q] = Estimate{-300e6, 200e6, -700e6, 100e6};
    EXPECT_EQ(reasons_against(fit).size(), q == 0 ? 1U : 0U) << "may be zero";
  }
  Fit fit = sound_fit();
  fit.coefficients[2] = Estimate{-300e6, 10e6, -320e6, -280e6};
  EXPECT_TRUE(reasons_against(fit).empty()) << "the axial force may pull either way";
}

TEST(Trust, TheMaterialSaysItFirst) {
  Fit fit = sound_fit();
  EXPECT_FALSE(material_toml(fit, {}).starts_with("# Do not use"));
  fit.coefficients[1] = Estimate{-300e6, 10e6, -320e6, -280e6};
  EXPECT_TRUE(
      material_toml(fit, {}).starts_with("# Do not use these numbers: K_rc_MPa"));
}

TEST(FitsTable, WideValuesDoNotRunTogether) {
  std::vector<Fit> fits = {sound_fit(), sound_fit(), sound_fit()};
  fits[1].coefficients[5] = Estimate{1.0739e8, 7.4e7, -1.234e9, 2.345e9};
  fits[2].unidentifiable.emplace_back("radial_offsets_mm[2]", "why");
  fits[2].runout.radial_offsets[1] = 4.99112e-3;
  std::istringstream lines(fits_table(fits));
  std::size_t width = 0;
  for (std::string line; std::getline(lines, line);) {
    width = width == 0 ? line.size() : width;
    EXPECT_EQ(line.size(), width) << line;
    EXPECT_EQ(line.find("4991"), std::string::npos) << "it has no value";
    if (line.starts_with("K_ae")) {
      EXPECT_NE(line.find("  100000 +- 1800000  "), std::string::npos) << line;
    }
    if (line.starts_with("radial")) {
      EXPECT_NE(line.find("  -8.00 +- 0.20  "), std::string::npos) << line;
      EXPECT_TRUE(line.ends_with("  not known")) << line;
    }
  }
}

}  // namespace
}  // namespace trochoid::run
