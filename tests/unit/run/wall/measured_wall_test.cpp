#include <trochoid/base/error.h>
#include <trochoid/run/wall.h>

#include <gtest/gtest.h>

#include <cmath>

#include "wall_case.h"

namespace trochoid::run::measured_wall_test {

using namespace test;

cases::Case measured(const std::string& model, const std::string& readings,
                     const std::string& keys = "") {
  const auto* const info = testing::UnitTest::GetInstance()->current_test_info();
  const auto file = written(std::string(info->name()) + ".csv", readings);
  return case_of(cut_tables + cutter_table + wall_table +
                     "[sampling]\nsamples_per_rev = 30\n[surface]\nmodel = \"" + model +
                     "\"\n[[surface_measurement]]\nfile = \"" + file.string() + "\"\n" +
                     keys,
                 cases::Command::calibrate);
}

TEST(MeasuredWall, IsInSiWithItsTeethCountedFromZero) {
  const MeasuredWall wall = measured_wall(measured("imprint",
                                                   "x_mm,height_mm,error_mm,tooth\n"
                                                   "10,0.5,0.02,1\n"
                                                   "10.2,1.5,-0.01,3\n",
                                                   "datum_offset = true\n"));
  ASSERT_EQ(wall.readings.size(), 2U);
  const surface::Reading& second = wall.readings[1];
  EXPECT_NEAR(second.x, 10.2e-3, 1e-15);
  EXPECT_NEAR(second.travel, 10.2e-3, 1e-15);
  EXPECT_NEAR(second.height, 1.5e-3, 1e-15);
  EXPECT_NEAR(second.error, -0.01e-3, 1e-15);
  EXPECT_EQ(second.tooth, 2);
  ASSERT_EQ(wall.datum.size(), 1U);
  EXPECT_TRUE(wall.datum[0].offset);
  EXPECT_FALSE(wall.datum[0].tilt);
}

TEST(MeasuredWall, APulseIsAllMadeWhereTheCutterStands) {
  const MeasuredWall wall = measured_wall(
      measured("quasi_static", "step,height_mm,error_mm\n0,0.5,0\n15,0.5,0.01\n"));
  ASSERT_EQ(wall.readings.size(), 2U);
  for (const surface::Reading& reading : wall.readings) {
    EXPECT_EQ(reading.x, 20e-3);
    EXPECT_EQ(reading.tooth, -1);
  }
  EXPECT_NEAR(wall.readings[1].travel, 0.3e-3, 1e-12) << "half a turn of the feed";
}

/// Repeats of two files are pooled; a place that both have stays two readings.
TEST(MeasuredWall, CountsWhatWasLeftOutAndAveraged) {
  cases::Case given = measured("imprint",
                               "x_mm,height_mm,error_um,tooth\n"
                               "10,0.5,20,1\n"
                               "10,0.5,26,1\n"
                               "11,0.5,,1\n");
  given.machine.surface_measurements.push_back(given.machine.surface_measurements[0]);
  const MeasuredWall wall = measured_wall(given);
  ASSERT_EQ(wall.readings.size(), 2U);
  EXPECT_NEAR(wall.readings[0].error, 23e-6, 1e-15);
  EXPECT_EQ(wall.readings[1].set, 1U);
  EXPECT_EQ(wall.counts.skipped, 2U);
  EXPECT_EQ(wall.counts.repeats, 2U);
  EXPECT_NEAR(wall.counts.repeatability().value(), std::sqrt(18.0) * 1e-6, 1e-12);
  ASSERT_EQ(wall.notes.size(), 4U);
  EXPECT_EQ(wall.notes[0].code, "readings_skipped");
  EXPECT_NE(wall.notes[0].message.find(".csv: 1 of 3 rows"), std::string::npos);
  EXPECT_EQ(wall.notes[3].code, "repeats_averaged");
}

TEST(MeasuredWall, NamesWhatIsWrongWithItsPlaces) {
  const cases::Case given = measured("imprint",
                                     "x_mm,height_mm,error_mm\n"
                                     "10,0.5,0.02\n"
                                     "10,5,0.02\n");
  try {
    static_cast<void>(measured_wall(given));
    FAIL() << "a reading above the cut was taken";
  } catch (const base::InputError& error) {
    ASSERT_EQ(error.problems().size(), 1U);
    EXPECT_NE(error.problems()[0].find(".csv:3:"), std::string::npos)
        << error.problems()[0];
  }
}

}  // namespace trochoid::run::measured_wall_test
