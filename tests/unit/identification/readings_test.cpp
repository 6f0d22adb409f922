#include "made_record.h"

#include <gtest/gtest.h>
#include <trochoid/identification/readings.h>

#include <algorithm>
#include <cmath>

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

/// At one lead angle, as on a cylinder, eight readings are the same data: with Q and the
/// turned coefficients the channels are what they were.
TEST(Readings, OfAFaceMillAreSixFamiliesToo) {
  force::Setup setup = slot_setup(3, 5.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, 9.0 * unit::um, -6.0 * unit::um};
  setup.cutter.profile.beta = 35.0 * unit::deg;
  const auto families = reading_families(setup);
  ASSERT_EQ(families.size(), 6U);
  EXPECT_EQ(different(families), 48U);
  const std::vector<double> K{1500e6, 700e6, 300e6, 7e3, 5e3, 2e3};
  for (const ReadingFamily& family : families) {
    std::vector<std::array<double, 3>> first;
    for (const signal::AxesReading& reading : family) {
      std::vector<double> turned(6, 0.0);
      for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          turned[i] += reading.turn[i % 3][j] * K[i / 3 * 3 + j];
        }
      }
      const force::Law law = force::with_coefficients(steel(), turned);
      const Record record = made_record(setup, law, {.per_turn = 40});
      for (std::size_t i = 0; i < record.force.size(); ++i) {
        std::array<double, 3> channel{};
        for (std::size_t c = 0; c < 3; ++c) {
          for (std::size_t q = 0; q < 3; ++q) {
            channel[c] += reading.Q[c][q] * record.force[i][q];
          }
        }
        if (first.size() < record.force.size()) first.push_back(channel);
        for (std::size_t c = 0; c < 3; ++c) {
          ASSERT_NEAR(channel[c], first[i][c], 1e-4);
        }
      }
    }
  }
}

}  // namespace trochoid::identification::readings_test
