#include "made_record.h"

#include <gtest/gtest.h>
#include <trochoid/identification/readings.h>

#include <algorithm>

namespace trochoid::identification::readings_test {

std::size_t different(const std::vector<ReadingFamily>& families) {
  std::vector<signal::Matrix3> all;
  for (const ReadingFamily& family : families) {
    for (const signal::AxesReading& reading : family) {
      if (std::ranges::find(all, reading.Q) == all.end()) all.push_back(reading.Q);
    }
  }
  return all.size();
}

TEST(Readings, AreSixFamiliesOnACylinderAndTwentyFourElsewhere) {
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  EXPECT_EQ(reading_families(setup).size(), 6U);
  EXPECT_EQ(different(reading_families(setup)), 48U);
  setup.cutter.profile = geometry::ball(8.0 * unit::mm);
  EXPECT_EQ(reading_families(setup).size(), 24U);
  EXPECT_EQ(different(reading_families(setup)), 48U);
}

/// The rows read by Q are those of a record that was read by Q before.
TEST(Readings, ExchangeRowsAsTheyDoSamples) {
  const force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  const Record record = made_record(setup, steel(), {.turns = 2.0, .noise = 3.0});
  for (const int band : {0, 3}) {
    const Options options{.band_harmonics = band, .fit_channel_offsets = true};
    for (const signal::Matrix3& Q : signal::axes_candidates()) {
      Record read = record;
      for (auto& F : read.force) {
        const auto was = F;
        F = {};
        for (std::size_t c = 0; c < 3; ++c) {
          for (std::size_t q = 0; q < 3; ++q) F[q] += Q[c][q] * was[c];
        }
      }
      Problem channels;
      channels.runs = {fold(record, options)};
      const FoldedRun expected = fold(read, options);
      const FoldedRun found = read_by(channels, Q).runs.front();
      ASSERT_EQ(found.b.size(), expected.b.size());
      for (std::size_t i = 0; i < found.b.size(); ++i) {
        ASSERT_NEAR(found.b[i], expected.b[i], 1e-9);
      }
      EXPECT_NEAR(found.force[7][1], expected.force[7][1], 1e-12);
    }
  }
}

}  // namespace trochoid::identification::readings_test
