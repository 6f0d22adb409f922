#include "made_record.h"

#include <gtest/gtest.h>
#include <trochoid/identification/local_minimum.h>
#include <trochoid/identification/phase_grid.h>
#include <trochoid/identification/prepare.h>
#include <trochoid/identification/runout_starts.h>
#include <trochoid/identification/scan.h>

#include <cmath>

namespace trochoid::identification::scan_test {

force::Setup with_offset() {
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, 16.0 * unit::um};
  return setup;
}

Problem problem_of(const std::vector<Record>& runs, const Options& options) {
  return *prepare(without_runout(with_offset()), steel(), runs, options).problem;
}

/// At a phase that is a whole number of cells the scan says what a fit there says.
TEST(Scan, LeavesWhatAFitLeaves) {  // [I-12]
  const double cell = 2.0 * pi / 120.0;
  const std::vector<Record> runs = {
      made_record(with_offset(), steel(), {7.0 * cell, 120, 2.0, 3.0, 4})};
  for (const bool offsets : {false, true}) {
    const Problem problem = problem_of(runs, {.fit_channel_offsets = offsets});
    const std::vector<Candidate> found = scan(problem, {{0.4}});
    ASSERT_FALSE(found.empty());
    std::vector<double> p = found.front().p;
    EXPECT_NEAR(p[0], 0.4, 1e-15);
    EXPECT_NEAR(p[1], 7.0 * cell, 0.5 * cell);
    p[1] = 7.0 * cell;
    // A slope of the channels is not in the scan, and the tolerances are not the same.
    EXPECT_NEAR(found.front().rss / rss_at(problem, p), 1.0, offsets ? 0.02 : 2e-3);
  }
}

/// The same within a band, of records as coarse as they come.
TEST(Scan, LeavesWhatAFitOfABandLeaves) {  // [I-12]
  for (const int per_turn : {24, 48, 300}) {
    const std::vector<Record> runs = {
        made_record(with_offset(), steel(), {0.0, per_turn, 2.0, 3.0, 4})};
    const Problem problem = problem_of(runs, {.band_harmonics = 4});
    const std::vector<Candidate> found = scan(problem, {{0.4}});
    ASSERT_FALSE(found.empty());
    // What 24 samples a turn mistake for lower harmonics is not in the scan.
    EXPECT_NEAR(found.front().rss / rss_at(problem, found.front().p), 1.0, 0.1)
        << per_turn;
  }
}

TEST(Scan, ReadsTheChannelsEachWay) {  // [I-12]
  const Record record = made_record(with_offset(), steel(), {0.3, 120, 1.0, 0.0, 1});
  const signal::Matrix3 Q = {{{0, -1, 0}, {0, 0, 1}, {1, 0, 0}}};
  Record channels = record;
  for (std::size_t i = 0; i < record.force.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      channels.force[i][c] = 0.0;
      for (std::size_t q = 0; q < 3; ++q) {
        channels.force[i][c] += Q[c][q] * record.force[i][q];
      }
    }
  }
  for (const int band : {0, 4}) {
    const Options options{.band_harmonics = band};
    const auto direct = scan(problem_of({record}, options), {{0.4}});
    const auto read =
        scan(problem_of({channels}, options), {{0.4}}, std::vector<signal::Matrix3>{Q})
            .front();
    ASSERT_EQ(read.size(), direct.size());
    EXPECT_NEAR(read.front().rss, direct.front().rss, 1e-6 * direct.front().rss);
    EXPECT_NEAR(read.front().p[1], direct.front().p[1], 1e-9);
  }
}

/// Of several runs, the phases are those that go with one another.
TEST(Scan, NumbersTheTeethOfAllRunsAlike) {
  force::Setup fast = with_offset();
  fast.cut.f_z = 70.0 * unit::um;
  for (const double second : {0.5, 0.5 + pi}) {
    const std::vector<Record> runs = {
        made_record(with_offset(), steel(), {0.2, 120, 1.0, 5.0, 1}),
        made_record(fast, steel(), {second, 120, 1.0, 5.0, 2})};
    const Problem problem = problem_of(runs, {});
    const Candidate best = scan(problem, runout_starts(problem)).front();
    const double apart = best.p[2] - best.p[1] - (second - 0.2);
    EXPECT_NEAR(std::cos(apart), 1.0, 0.01) << second;
  }
}

TEST(PhaseGrid, OfABandAreItsForceAtEqualWeights) {
  const Record record = made_record(with_offset(), steel(), {0.0, 360, 2.0, 0.0, 1});
  const PhaseGrid cells = phase_grid_of(fold(record, {.band_harmonics = 2}));
  EXPECT_EQ(cells.size(), 64U);
  EXPECT_TRUE(cells.even);
  EXPECT_EQ(cells.harmonics, 2);
  const PhaseGrid all = phase_grid_of(fold(record, {}));
  EXPECT_EQ(all.size(), 120U);
  EXPECT_TRUE(all.even);
  EXPECT_LT(cells.squares, all.squares);
}

TEST(PhaseGrid, OfPartOfATurnKeepTheirWeights) {
  const Record record = made_record(with_offset(), steel(), {0.0, 360, 0.5, 0.0, 1});
  const PhaseGrid cells = phase_grid_of(fold(record, {.band_harmonics = 2}));
  EXPECT_FALSE(cells.even);
  EXPECT_EQ(cells.harmonics, 0);
  EXPECT_EQ(cells.weight.back(), 0.0);
}

}  // namespace trochoid::identification::scan_test
