#include <trochoid/results/curve_tables.h>

#include <trochoid/base/units.h>

#include <gtest/gtest.h>

#include <cmath>

/// Long records are shown by their mean turn.
namespace trochoid::results::mean_turns_test {

TEST(MeanTurns, AreTheMeansOfSamplesAtTheSameAngle) {
  identification::Run run;
  std::vector<std::array<double, 3>> fitted;
  for (int i = 0; i < 8 * 100; ++i) {
    const double phi = unit::turn * (i + 0.5) / 8;
    const double drift = i < 400 ? -1.0 : 1.0;  // cancels over all turns
    run.angle.push_back(phi);
    run.force.push_back({std::sin(phi) + drift, 2.0, drift});
    fitted.push_back({std::sin(phi), 0.0, 0.0});
  }
  std::vector<ComputedForces> computed{{"trochoidal", {fitted}}};
  const auto mean = mean_turns(std::span(&run, 1), computed);
  ASSERT_EQ(mean.size(), 1U);
  ASSERT_EQ(mean[0].angle.size(), 8U);
  ASSERT_EQ(computed[0].of_run[0].size(), 8U);
  for (std::size_t b = 0; b < 8; ++b) {
    EXPECT_NEAR(mean[0].angle[b], unit::turn * (static_cast<double>(b) + 0.5) / 8,
                1e-9);
    EXPECT_NEAR(mean[0].force[b][0], std::sin(mean[0].angle[b]), 1e-9);
    EXPECT_NEAR(mean[0].force[b][1], 2.0, 1e-12);
    EXPECT_NEAR(mean[0].force[b][2], 0.0, 1e-12);
    EXPECT_NEAR(computed[0].of_run[0][b][0], std::sin(mean[0].angle[b]), 1e-9);
  }
}

}  // namespace trochoid::results::mean_turns_test
