#include <gtest/gtest.h>
#include <trochoid/base/units.h>
#include <trochoid/files/record_file.h>
#include <trochoid/signal/spindle_speed.h>

#include <filesystem>

namespace trochoid::files::record_real_test {

/// Exports that may not be shipped; they lie beside the project where they lie at all.
const std::filesystem::path folder =
    std::filesystem::path(TROCHOID_SOURCE_DIR) / "../shared/data/slot_d25_dynoware";

TEST(RealRecord, IsReadAndItsSpindleSpeedFound) {
  for (const auto& [name, first] :
       {std::pair{"n6000_f600_ap3.csv", 5.0}, {"n6000_f1200_ap3.csv", 2.0}}) {
    RecordSource m;
    m.file.path = folder / name;
    if (!std::filesystem::exists(m.file.path))
      GTEST_SKIP() << m.file.path << " is not here";
    const auto record = read_record(m);
    EXPECT_EQ(record.size(), 10001u);
    EXPECT_EQ(record.sample_rate, 1e4);
    EXPECT_DOUBLE_EQ(record.time.front(), first);
    EXPECT_DOUBLE_EQ(record.time.back(), first + 1.0);
    ASSERT_EQ(record.notes.size(), 1u);
    EXPECT_EQ(record.notes[0].code, "part_of_record");
    // An independent program found 5999.73 and 5999.81 rpm; the stated speed must not
    // matter, and 0.02 % are 1.2 rpm.
    for (const double stated : {5800.0, 6000.0, 6200.0}) {
      const auto speed =
          signal::spindle_speed(record, {.Omega = stated * unit::rpm, .teeth = 2});
      ASSERT_TRUE(speed.ok) << speed.message;
      EXPECT_NEAR(speed.Omega / unit::rpm, 5999.77, 0.1);
    }
  }
}

}  // namespace trochoid::files::record_real_test
