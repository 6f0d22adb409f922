#include <trochoid/run/records.h>

#include <trochoid/base/units.h>

#include <gtest/gtest.h>

namespace trochoid::run::describe_record_test {

TEST(DescribeRecord, TellsTimesByTheStatedSpeed) {
  signal::Record record{.file = "a.csv", .sample_rate = 1000.0};
  for (int i = 0; i < 1001; ++i) {
    record.time.push_back(1e-3 * i);
    for (auto& c : record.channel) {
      c.push_back(i == 0 ? -10.0 : 30.0);
    }
  }
  record.channel_column = {"Fx", "Fy", "Fz"};
  record.time_column = "t";
  cases::Measurement measurement;
  measurement.cut.Omega = 600 * unit::rpm;
  EXPECT_EQ(describe_record(record, measurement),
            "a.csv: 1001 samples, 1 s at 1000 Hz, about 10.0 revolutions at the stated "
            "600 rpm\n"
            "  time from column t\n"
            "  channel 1 from column Fx: -10 to 30 N, mean 29.96 N\n"
            "  channel 2 from column Fy: -10 to 30 N, mean 29.96 N\n"
            "  channel 3 from column Fz: -10 to 30 N, mean 29.96 N\n");
}

TEST(DescribeRecord, CountsAnglesThatStartAnew) {
  signal::Record record{.file = "b.csv"};
  for (int i = 0; i <= 30; ++i) {
    record.angle.push_back((i % 10) * 0.1 * unit::turn);
    for (auto& c : record.channel) {
      c.push_back(1.0);
    }
  }
  record.angle_column = "angle_deg";
  const std::string text = describe_record(record, {});
  EXPECT_EQ(text.find("b.csv: 31 samples, no time, 3.00 revolutions by their angles\n"
                      "  angle from column angle_deg\n"),
            0U)
      << text;
}

}  // namespace trochoid::run::describe_record_test
