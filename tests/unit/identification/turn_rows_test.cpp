#include "made_record.h"

#include <gtest/gtest.h>
#include <trochoid/identification/folded.h>

#include <cmath>
#include <numeric>

namespace trochoid::identification::turn_rows_test {

/// Angles that never come back, with the force of a tool.
Record asynchronous(const force::Setup& setup, int samples, double noise) {
  Record out;
  out.cut = setup.cut;
  std::vector<double> phi;
  for (int i = 0; i < samples; ++i) {
    out.angle.push_back(0.0521 * i);
    phi.push_back(out.angle.back() + 0.4);
  }
  out.force = force::forces(setup, steel(), phi, 1e-9);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (auto& F : out.force) {
    for (double& f : F) f += noise * normal(random);
  }
  return out;
}

TEST(TurnRows, AreTheRowsOfTheSamples) {  // [I-11]
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  const FoldedRun run = fold(asynchronous(setup, 3000, 0.0), {.band_harmonics = 6});
  ASSERT_FALSE(run.turn_map.empty());
  const force::ForceMatrix matrix(setup, steel(), 1e-9);
  std::vector<double> phi(run.angle);
  for (double& a : phi) a += 0.4;
  std::vector<double> C(18 * phi.size());
  matrix.evaluate(phi, C);
  const std::vector<double> at_samples = rows_of(run, C, 6);
  const TurnMatrix turn = turn_matrix(matrix, {1024, run.highest, false});
  const std::vector<double> of_turn = rows_of_turn(run, at_phase(turn, 0.4), 6);
  ASSERT_EQ(of_turn.size(), at_samples.size());
  double largest = 0.0;
  double off = 0.0;
  for (std::size_t i = 0; i < of_turn.size(); ++i) {
    largest = std::max(largest, std::abs(at_samples[i]));
    off = std::max(off, std::abs(of_turn[i] - at_samples[i]));
  }
  // One part in 25 turns of the harmonics beyond the 63rd, themselves below a
  // thousandth, is mistaken for lower ones.
  EXPECT_LT(off, 4e-5 * largest);
}

TEST(TurnRows, FewAnglesAndWideBandsKeepTheirSamples) {
  const force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  EXPECT_TRUE(
      fold(made_record(setup, steel(), {}), {.band_harmonics = 6}).turn_map.empty());
  EXPECT_TRUE(
      fold(asynchronous(setup, 2000, 0.0), {.band_harmonics = 33}).turn_map.empty());
  EXPECT_TRUE(fold(asynchronous(setup, 2000, 0.0), {}).turn_map.empty());
}

/// A bin, a band and a fit keep the statistics of the samples.
TEST(TurnRows, AsynchronousRecordsAnswerWithinTheirErrors) {
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  const std::vector<Record> runs = {asynchronous(setup, 6000, 10.0)};
  const Fit fit = identify(without_runout(setup), steel(), runs, {.band_harmonics = 6});
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_NEAR(fit.phase[0], 0.4, 4.0 * *fit.phase_se[0]);
  EXPECT_NEAR(fit.runout.radial_offsets[1], -8e-6, 4.0 * *fit.radial_offsets_se[1]);
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_NEAR(fit.coefficients[c]->value, force::coefficients(steel())[c],
                4.0 * fit.coefficients[c]->se);
  }
  // White noise of 10 N in the 39 rows of 13 functions: 10 sqrt((39 - 8)/6000).
  EXPECT_NEAR(fit.rms, 10.0 * std::sqrt(31.0 / 6000.0), 0.3);
}

}  // namespace trochoid::identification::turn_rows_test
