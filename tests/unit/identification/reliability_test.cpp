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

TEST(Reliability, ReasonsMakeOneSentence) {
  EXPECT_EQ(do_not_use({"this is so", "that is so"}),
            "Do not use these numbers: this is so; that is so.");
}

}  // namespace trochoid::identification::reliability_test
