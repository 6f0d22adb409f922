#include "sound_fit.h"

#include <trochoid/identification/reliability.h>

#include <gtest/gtest.h>

namespace trochoid::identification::reliability_test {

using test::sound_fit;

TEST(Reliability, NothingSpeaksAgainstASoundFit) {
  EXPECT_TRUE(reasons_against(sound_fit()).empty());
}

TEST(Reliability, HalfOfTheForceUnexplainedIsTooMuchUnlessItIsNoise) {  // [I-9]
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

TEST(Reliability, NegativeCuttingCoefficientsAreWrong) {
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

TEST(Reliability, WhatIsHardlyKnownIsNamed) {
  Fit fit = sound_fit();
  EXPECT_TRUE(poorly_known(fit).empty());
  fit.coefficients[0] = Estimate{2600e6, 195e6, 2210e6, 2990e6};
  ASSERT_EQ(poorly_known(fit).size(), 1U);
  EXPECT_EQ(poorly_known(fit)[0], "K_tc_MPa is known to 15 % only");
  EXPECT_TRUE(reasons_against(fit).empty());
  fit.coefficients[0] = Estimate{2600e6, 910e6, 780e6, 4420e6};
  ASSERT_EQ(reasons_against(fit).size(), 1U);
  EXPECT_EQ(reasons_against(fit)[0], "K_tc_MPa is known to 70 % only");
  fit = sound_fit();  // K_ac is 330 MPa, a tenth of a third of K_tc is 78 MPa
  fit.coefficients[2] = Estimate{330e6, 35e6, 260e6, 400e6};
  EXPECT_TRUE(poorly_known(fit).empty()) << "small beside K_tc";
  fit.coefficients[2] = Estimate{330e6, 50e6, 230e6, 430e6};
  EXPECT_EQ(poorly_known(fit).size(), 1U);
  fit.coefficients[2] = Estimate{50e6, 50e6, -50e6, 150e6};
  ASSERT_EQ(poorly_known(fit).size(), 1U);
  EXPECT_EQ(poorly_known(fit)[0], "K_ac_MPa may be zero");
  fit = sound_fit();
  fit.widening = 12.0;
  EXPECT_EQ(poorly_known(fit)[0], "the intervals are 12 times wider than by noise");
}

TEST(Reliability, ReasonsMakeOneSentence) {
  EXPECT_EQ(do_not_use({"this is so", "that is so"}),
            "Do not use these numbers: this is so; that is so.");
}

}  // namespace trochoid::identification::reliability_test
