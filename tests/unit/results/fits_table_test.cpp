#include "../identification/sound_fit.h"

#include <trochoid/results/fit_value.h>
#include <trochoid/results/fits_table.h>
#include <trochoid/results/json.h>
#include <trochoid/results/material.h>

#include <gtest/gtest.h>

#include <sstream>

namespace trochoid::results::fits_table_test {

using identification::Estimate;
using identification::Fit;
using identification::test::sound_fit;

TEST(Material, SaysFirstThatItMustNotBeUsed) {
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

TEST(FitValue, WhatCannotBeToldIsNull) {
  Fit fit = sound_fit();
  fit.coefficients[5].reset();
  fit.unidentifiable.emplace_back("K_ae_N_per_mm", "the record does not hold it");
  fit.unidentifiable.emplace_back("phase_deg", "nor that");
  const Value value = fit_fields().object({fit});
  const Value* K = find(value, "coefficients");
  ASSERT_NE(K, nullptr);
  EXPECT_EQ(json_text(*find(*K, "K_ae_N_per_mm")), "null");
  EXPECT_EQ(json_text(*find(*find(*K, "K_tc_MPa"), "value")), "2600");
  EXPECT_EQ(json_text(*find(value, "phase_deg")), "null");
  EXPECT_EQ(json_text(*find(*find(value, "identifiable"), "K_ae_N_per_mm")),
            "\"the record does not hold it\"");
}

}  // namespace trochoid::results::fits_table_test
