#include "made_record.h"

#include <gtest/gtest.h>
#include <trochoid/numerics/student.h>

#include <cmath>

namespace trochoid::identification::linear_fit_test {

Options fixed_runout() {
  Options out;
  out.runout = RunoutUnknowns::fixed;
  out.phase = 0.0;
  return out;
}

force::Setup paper_cut() {
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  return setup;
}

TEST(LinearFit, ReturnsTheCoefficientsOfANoiselessRecord) {  // [I-1]
  const force::Setup setup = paper_cut();
  const std::vector<Record> runs = {made_record(setup, steel(), {})};
  const Fit fit = identify(setup, steel(), runs, fixed_runout());
  ASSERT_TRUE(fit.ok) << fit.message;
  const std::vector<double> K = force::coefficients(steel());
  for (std::size_t c = 0; c < K.size(); ++c) {
    EXPECT_NEAR(fit.coefficients[c]->value, K[c], 1e-8 * K[c]) << c;
  }
  EXPECT_EQ(fit.rank, 6);
  EXPECT_GT(fit.condition, 3.0);
  EXPECT_LT(fit.condition, 10.0);
  EXPECT_FALSE(fit.phase_se[0].has_value()) << "a given phase has no error";
}

TEST(LinearFit, StandardErrorsAreThoseOfManyRepetitions) {  // [I-2]
  const force::Setup setup = paper_cut();
  const int repetitions = 60;
  double sum = 0.0;
  double squares = 0.0;
  double se = 0.0;
  for (int i = 0; i < repetitions; ++i) {
    Sampling noisy;
    noisy.noise = 10.0;
    noisy.per_turn = 120;
    noisy.seed = 100U + static_cast<unsigned>(i);
    const std::vector<Record> runs = {made_record(setup, steel(), noisy)};
    const Fit fit = identify(setup, steel(), runs, fixed_runout());
    const double K_tc = fit.coefficients[0]->value;
    sum += K_tc;
    squares += K_tc * K_tc;
    se += fit.coefficients[0]->se / repetitions;
  }
  const double mean = sum / repetitions;
  const double scatter =
      std::sqrt((squares - repetitions * mean * mean) / (repetitions - 1));
  // The scatter of 60 values is known to 9 %; three times that.
  EXPECT_NEAR(scatter / se, 1.0, 0.28);
  EXPECT_NEAR(mean, 2600e6, 4.0 * se / std::sqrt(repetitions));
}

TEST(LinearFit, RmsIsThatOfTheVector) {  // [I-5]
  const force::Setup setup = paper_cut();
  Sampling noisy;
  noisy.noise = 10.0;
  const std::vector<Record> runs = {made_record(setup, steel(), noisy)};
  const Fit fit = identify(setup, steel(), runs, fixed_runout());
  double sum = 0.0;
  std::array<double, 3> axis{};
  for (std::size_t i = 0; i < runs[0].force.size(); ++i) {
    for (std::size_t q = 0; q < 3; ++q) {
      const double d = runs[0].force[i][q] - fit.fitted[0][i][q];
      sum += d * d / 360.0;
      axis[q] += d * d / 360.0;
    }
  }
  EXPECT_NEAR(fit.rms, std::sqrt(sum), 1e-10);
  EXPECT_NEAR(fit.rms, 10.0 * std::sqrt(3.0), 1.0);
  for (std::size_t q = 0; q < 3; ++q) {
    EXPECT_NEAR(fit.rms_axis[q], std::sqrt(axis[q]), 1e-10);
  }
}

TEST(LinearFit, IntervalsAreStudents) {  // [I-8]
  const force::Setup setup = paper_cut();
  Sampling few;
  few.per_turn = 6;
  few.noise = 5.0;
  const std::vector<Record> runs = {made_record(setup, steel(), few)};
  const Fit fit = identify(setup, steel(), runs, fixed_runout());
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_EQ(fit.freedom, 12.0);
  const Estimate& K_tc = *fit.coefficients[0];
  EXPECT_NEAR(K_tc.high - K_tc.value, 2.17881282966723 * K_tc.se, 1e-9 * K_tc.value);
  EXPECT_NEAR(K_tc.value - K_tc.low, K_tc.high - K_tc.value, 1e-9 * K_tc.value);
}

TEST(LinearFit, ResidualCorrelationShowsWhatTheModelMisses) {  // [I-8]
  const force::Setup setup = paper_cut();
  Sampling noisy;
  noisy.noise = 5.0;
  const std::vector<Record> runs = {made_record(setup, steel(), noisy)};
  Options options = fixed_runout();
  EXPECT_LT(std::abs(identify(setup, steel(), runs, options).residual_correlation),
            0.1);
  options.chip_model = chip::Model::none;
  EXPECT_GT(identify(setup, steel(), runs, options).residual_correlation, 0.8);
}

TEST(LinearFit, ChannelOffsetsAndSlopesAreFound) {  // [I-7]
  const force::Setup setup = paper_cut();
  Sampling two_turns;
  two_turns.turns = 2.0;
  std::vector<Record> runs = {made_record(setup, steel(), two_turns)};
  const std::size_t n = runs[0].force.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(n - 1) - 0.5;
    runs[0].force[i][0] += 12.0 - 30.0 * t;
    runs[0].force[i][2] -= 5.0;
  }
  Options options = fixed_runout();
  options.fit_channel_offsets = true;
  const Fit fit = identify(setup, steel(), runs, options);
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_NEAR(fit.channel_offsets[0][0].constant, 12.0, 1e-6);
  EXPECT_NEAR(fit.channel_offsets[0][0].slope, -30.0, 1e-6);
  EXPECT_NEAR(fit.channel_offsets[0][1].constant, 0.0, 1e-6);
  EXPECT_NEAR(fit.channel_offsets[0][2].constant, -5.0, 1e-6);
  EXPECT_NEAR(fit.coefficients[0]->value, 2600e6, 1.0);
  EXPECT_LT(fit.rms, 1e-6);
  EXPECT_EQ(fit.rank, 12);
}

TEST(LinearFit, BandLimitIgnoresWhatIsAboveTheBand) {  // [I-1]
  const force::Setup setup = paper_cut();
  std::vector<Record> runs = {made_record(setup, steel(), {})};
  for (std::size_t i = 0; i < runs[0].force.size(); ++i) {
    runs[0].force[i][1] += 40.0 * std::sin(23.0 * runs[0].angle[i]);
  }
  Options options = fixed_runout();
  EXPECT_GT(identify(setup, steel(), runs, options).rms, 20.0);
  options.band_harmonics = 12;
  const Fit fit = identify(setup, steel(), runs, options);
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_LT(fit.rms, 1e-6);
  EXPECT_NEAR(fit.coefficients[0]->value, 2600e6, 10.0);
  EXPECT_EQ(fit.freedom, 3.0 * 25.0 - 6.0);
}

TEST(LinearFit, SweepHasItsMinimumAtTheTrueOffset) {  // [I-5]
  const force::Setup setup = paper_cut();
  const std::vector<Record> runs = {made_record(setup, steel(), {})};
  const Fit fit = identify(setup, steel(), runs, fixed_runout());
  const std::vector<double> offsets = {-10e-6, -8e-6, -6e-6, 0.0};
  const std::vector<double> rms = sweep(setup, steel(), runs, fit, offsets);
  ASSERT_EQ(rms.size(), 4U);
  EXPECT_LT(rms[1], 1e-5);
  EXPECT_GT(rms[0], 1.0);
  EXPECT_GT(rms[2], 1.0);
  EXPECT_GT(rms[3], rms[2]);
  Options none = fixed_runout();
  none.runout = RunoutUnknowns::none;
  EXPECT_NEAR(rms[3], identify(setup, steel(), runs, none).rms, 1e-6);
}

}  // namespace trochoid::identification::linear_fit_test
