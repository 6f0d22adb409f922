#include "made_record.h"

#include <gtest/gtest.h>
#include <trochoid/identification/folded.h>

#include <cmath>

namespace trochoid::identification::fold_test {

Record ramp(int turns, int per_turn) {
  Record out;
  for (int i = 0; i < turns * per_turn; ++i) {
    out.angle.push_back(2.0 * pi * i / per_turn);
    const double t = i;
    out.force.push_back({std::sin(0.1 * t), t, 1.0});
  }
  return out;
}

TEST(Fold, RepeatedAnglesBecomeOneRow) {  // [I-1]
  const FoldedRun folded = fold(ramp(3, 36), {});
  EXPECT_EQ(folded.angle.size(), 36U);
  EXPECT_EQ(folded.rows, 108);
  EXPECT_NEAR(folded.weight[5], std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(folded.force[5][1], 5.0 + 36.0, 1e-12);
}

TEST(Fold, AnglesThatDoNotRepeatStayApart) {
  Record run = ramp(2, 36);
  for (std::size_t i = 36; i < run.angle.size(); ++i) run.angle[i] += 1e-3;
  EXPECT_EQ(fold(run, {}).angle.size(), 72U);
}

TEST(Fold, SlopeRowKeepsTheSquares) {  // [I-7]
  // Sum of squares of the slope column: over all samples, and over the folded rows.
  Options options;
  options.fit_channel_offsets = true;
  const Record run = ramp(3, 36);
  const FoldedRun folded = fold(run, options);
  double all = 0.0;
  double product = 0.0;
  for (std::size_t i = 0; i < run.angle.size(); ++i) {
    const double s = slope_at(i, run.angle.size());
    all += s * s;
    product += s * run.force[i][1];
  }
  double kept = 0.0;
  double kept_product = 0.0;
  for (std::size_t row = 0; row < static_cast<std::size_t>(folded.rows); ++row) {
    const double s = folded.drift[6 * row + 3];  // slope of channel 2
    kept += s * s;
    kept_product += s * folded.b[row];
  }
  EXPECT_NEAR(kept, all, 1e-12 * all);
  EXPECT_NEAR(kept_product, product, 1e-12 * product);
}

TEST(Fold, BandKeepsItsHarmonicsAndNothingElse) {
  Record run;
  for (int i = 0; i < 200; ++i) {
    const double a = 0.1 * i;
    run.angle.push_back(a);
    run.force.push_back({3.0, std::cos(2.0 * a), 0.0});
  }
  Options options;
  options.band_harmonics = 2;
  const FoldedRun folded = fold(run, options);
  EXPECT_EQ(folded.rows, 15);
  double kept = 0.0;
  for (const double b : folded.b) kept += b * b;
  double all = 0.0;
  for (const auto& F : run.force) all += F[0] * F[0] + F[1] * F[1];
  EXPECT_NEAR(kept, all, 1e-10 * all);
  options.band_harmonics = 1;
  double less = 0.0;
  for (const double b : fold(run, options).b) less += b * b;
  EXPECT_LT(less, all - 50.0);
}

TEST(Fold, VeryManyAnglesAreAveraged) {
  Record run = ramp(1, 36);
  run.angle.clear();
  run.force.clear();
  for (int i = 0; i < 20000; ++i) {
    run.angle.push_back(0.0123456 * i);
    run.force.push_back({std::sin(run.angle.back()), 0.0, 0.0});
  }
  const FoldedRun folded = fold(run, {});
  EXPECT_LE(folded.angle.size(), 3600U);
  double samples = 0.0;
  for (std::size_t g = 0; g < folded.angle.size(); ++g) {
    samples += folded.weight[g] * folded.weight[g];
    EXPECT_NEAR(folded.force[g][0], std::sin(folded.angle[g]), 1e-6);
  }
  EXPECT_NEAR(samples, 20000.0, 1e-6);
}

}  // namespace trochoid::identification::fold_test
