#include "made_record.h"

#include <gtest/gtest.h>
#include <trochoid/identification/folded.h>
#include <trochoid/identification/reliability.h>
#include <trochoid/identification/residuals.h>
#include <trochoid/identification/uncertainty.h>

#include <cmath>

namespace trochoid::identification::residuals_test {

force::Setup paper_cut() {
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  return setup;
}

Options fixed_runout() {
  Options out;
  out.runout = RunoutUnknowns::fixed;
  out.phase = 0.0;
  return out;
}

/// A disturbance that no force of the cut resembles.
void disturb(Record& run, double amplitude, int harmonic) {
  for (std::size_t i = 0; i < run.angle.size(); ++i) {
    for (std::size_t q = 0; q < 3; ++q) {
      run.force[i][q] +=
          amplitude * std::sin(harmonic * run.angle[i] + static_cast<double>(q));
    }
  }
}

TEST(Unexplained, IsThePartOfTheForceThatIsLeft) {  // [I-9]
  const force::Setup setup = paper_cut();
  std::vector<Record> runs = {made_record(setup, steel(), {})};
  EXPECT_LT(identify(setup, steel(), runs, fixed_runout()).unexplained.all, 1e-8);
  disturb(runs[0], 20.0, 29);
  const Fit fit = identify(setup, steel(), runs, fixed_runout());
  ASSERT_TRUE(fit.ok) << fit.message;
  double squares = 0.0;
  for (const auto& F : runs[0].force) {
    squares += F[0] * F[0] + F[1] * F[1] + F[2] * F[2];
  }
  const double size = std::sqrt(squares / static_cast<double>(runs[0].force.size()));
  EXPECT_NEAR(fit.unexplained.all, fit.rms / size, 1e-12);
  EXPECT_NEAR(fit.unexplained.in_band, fit.unexplained.all, 1e-12);
  EXPECT_EQ(fit.unexplained.outside, 0.0);
}

TEST(Unexplained, InABandDoesNotCountWhatLiesOutside) {  // [I-9]
  const force::Setup setup = paper_cut();
  std::vector<Record> runs = {made_record(setup, steel(), {})};
  disturb(runs[0], 100.0, 29);
  Options options = fixed_runout();
  options.band_harmonics = 4;
  const Fit fit = identify(setup, steel(), runs, options);
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_LT(fit.unexplained.in_band, 1e-6);
  EXPECT_GT(fit.unexplained.outside, 0.4);
  EXPECT_NEAR(fit.unexplained.all, fit.unexplained.outside, 0.1);
}

TEST(Unexplained, AConstantOfAChannelIsNoForce) {  // [I-9] [I-7]
  const force::Setup setup = paper_cut();
  std::vector<Record> runs = {made_record(setup, steel(), {})};
  disturb(runs[0], 20.0, 29);
  Options options = fixed_runout();
  options.fit_channel_offsets = true;
  const double before = identify(setup, steel(), runs, options).unexplained.all;
  for (auto& F : runs[0].force) F[0] += 1e4;
  EXPECT_NEAR(identify(setup, steel(), runs, options).unexplained.all, before, 1e-6);
}

TEST(Unexplained, EachRunCountsInItsOwnBand) {  // [I-5] [I-9]
  // The second run has fewer samples than the band has functions: it keeps them all.
  const force::Setup setup = paper_cut();
  Sampling few;
  few.per_turn = 20;
  std::vector<Record> runs = {made_record(setup, steel(), {}),
                              made_record(setup, steel(), few)};
  Options options = fixed_runout();
  options.band_harmonics = 15;
  const double noise = 3.0;
  for (std::size_t i = 0; i < runs[1].force.size(); ++i) {
    runs[1].force[i][0] += i % 2 == 0 ? noise : -noise;
  }
  for (const auto& order :
       {std::vector<Record>{runs[0], runs[1]}, std::vector<Record>{runs[1], runs[0]}}) {
    const Fit fit = identify(setup, steel(), order, options);
    ASSERT_TRUE(fit.ok) << fit.message;
    EXPECT_NEAR(fit.rms, noise * std::sqrt(20.0 / 380.0), 0.02 * noise);
  }
}

TEST(Refusal, AFitThatExplainsNothing) {  // [I-9]
  const force::Setup setup = paper_cut();
  std::vector<Record> runs = {made_record(setup, steel(), {})};
  for (auto& F : runs[0].force) {
    for (double& f : F) f *= 0.01;
  }
  disturb(runs[0], 100.0, 7);
  const Fit fit = identify(setup, steel(), runs, fixed_runout());
  EXPECT_FALSE(fit.ok);
  EXPECT_NE(fit.message.find("explains"), std::string::npos) << fit.message;
  for (const auto& K : fit.coefficients) EXPECT_FALSE(K.has_value());
}

TEST(Refusal, NotOfMuchWhiteNoise) {  // [I-9]
  // Honest intervals: many samples find a force below the noise.
  const force::Setup setup = paper_cut();
  Sampling noisy;
  noisy.turns = 40.0;
  noisy.noise = 600.0;
  const std::vector<Record> runs = {made_record(setup, steel(), noisy)};
  const Fit fit = identify(setup, steel(), runs, fixed_runout());
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_GT(fit.unexplained.all, std::sqrt(0.9));
  EXPECT_NEAR(fit.coefficients[0]->value, 2600e6, 4.0 * fit.coefficients[0]->se);
}

TEST(Residuals, FactorOfTheirCorrelation) {  // [I-8]
  EXPECT_EQ(correlation_factor(0.0), 1.0);
  EXPECT_EQ(correlation_factor(-0.5), 1.0);
  EXPECT_NEAR(correlation_factor(0.6), 2.0, 1e-12);
  EXPECT_LT(correlation_factor(1.0), 100.0);
}

TEST(Uncertainty, AnOffsetWhereAToothStopsCuttingHasNoStandardError) {  // [I-4]
  // Tooth 2 shorter by exactly the feed: beyond it nothing changes any more.
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -40.0 * unit::um};
  setup.chip.model = chip::Model::feed;
  Options options = fixed_runout();
  const std::vector<Record> runs = {made_record(setup, steel(), {})};
  Problem problem;
  problem.setup = setup;
  problem.law = steel();
  problem.runs.push_back(fold(runs[0], options));
  problem.unknowns.runout = RunoutUnknowns::offsets;
  problem.unknowns.teeth = 2;
  problem.unknowns.length = 40.0 * unit::um;
  problem.columns = 6;
  const std::vector<double> K = force::coefficients(steel());
  const auto known_at = [&](double p) {
    return uncertainty(
        problem, std::vector<double>{p}, K,
        {.rss = 1.0, .equations = 1080.0, .runs = {}, .fitted = {}, .rows = {}});
  };
  EXPECT_TRUE(known_at(-1.0).on_edge[6]);
  EXPECT_EQ(known_at(-1.0).covariance[48], 0.0);
  EXPECT_FALSE(known_at(-0.5).on_edge[6]);
  EXPECT_GT(known_at(-0.5).covariance[48], 0.0);
}

}  // namespace trochoid::identification::residuals_test
