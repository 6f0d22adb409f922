#include <gtest/gtest.h>
#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/files/numeric_table.h>

#include <cmath>
#include <limits>

namespace trochoid::files::record_numeric_test {

struct Made {
  NumericColumn column;
  std::vector<double> values;
};

NumericTable table_of(const std::vector<Made>& made) {
  NumericTable table;
  for (const auto& [column, values] : made) {
    table.columns.push_back(column);
    table.columns.back().count = values.size();
  }
  table.values = [made](std::size_t i) { return made[i].values; };
  return table;
}

std::string refusal(const std::vector<Made>& made, const RecordSource& m = {}) {
  try {
    record_of(table_of(made), "r.bin", m);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

Made column(std::string name, std::string unit, std::vector<double> values,
            double rate = 0.0) {
  return {{.name = std::move(name), .unit = std::move(unit), .sample_rate = rate},
          std::move(values)};
}

TEST(RecordNumeric, FindsColumnsByTheNamesOfText) {
  const auto record = record_of(
      table_of({column("Fz [mN]", "", {7, 8}), column("angle", "deg", {0, 90}),
                column("Fx", "kN", {1, 2}), column("F_y_N", "", {3, 4})}),
      "r.bin", {});
  EXPECT_EQ(record.file, "r.bin");
  EXPECT_EQ(record.channel[0], (std::vector{1e3, 2e3}));
  EXPECT_EQ(record.channel[1], (std::vector{3.0, 4.0}));
  EXPECT_EQ(record.channel[2], (std::vector{7e-3, 8e-3}));
  EXPECT_DOUBLE_EQ(record.angle[1], 90 * unit::deg);
  EXPECT_EQ(record.channel_column[2], "Fz [mN]");
  EXPECT_TRUE(record.notes.empty());
}

TEST(RecordNumeric, TakesTheRateThatTheColumnsState) {
  auto made =
      std::vector{column("Fx", "N", {1, 2, 3}, 1e4), column("Fy", "N", {1, 2, 3}, 1e4),
                  column("Fz", "N", {1, 2, 3}, 1e4)};
  for (auto& one : made) one.column.first_time = 0.5;
  const auto record = record_of(table_of(made), "r.bin", {});
  EXPECT_EQ(record.sample_rate, 1e4);
  EXPECT_DOUBLE_EQ(record.time[2], 0.5002);
  RecordSource m;
  m.sample_rate = 2e4;
  EXPECT_EQ(refusal(made, m),
            "r.bin: the sampling rate here is 10000 Hz, the case file says 20000 Hz: "
            "they must agree\n");
  made[1].column.sample_rate = 5e3;
  EXPECT_EQ(refusal(made),
            "r.bin: column \"Fy\" has 5000 samples a second, \"Fx\" has 10000: they "
            "must be sampled together\n");
  made[0].column.sample_rate = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal(made).find("a number from 0.001 to 1e9"), std::string::npos);
}

TEST(RecordNumeric, GoesWithoutAChannelThatIsNotThere) {
  auto made = std::vector{column("Fx", "N", {1, 2, 5}), column("Fy", "N", {3, 4, 6})};
  RecordSource m;
  m.sample_rate = 1e4;
  const auto record = record_of(table_of(made), "r.bin", m);
  EXPECT_EQ(record.measured, (std::array{true, true, false}));
  EXPECT_EQ(record.channel[2], (std::vector{0.0, 0.0, 0.0}));
  EXPECT_EQ(record.notes.at(0).code, "channel_missing");
  m.columns = {"", "Fx", ""};
  EXPECT_EQ(record_of(table_of(made), "r.bin", m).channel[0],
            (std::vector{0., 0., 0.}));
  EXPECT_EQ(record_of(table_of(made), "r.bin", m).size(), 3U);
}

TEST(RecordNumeric, TellsColumnsOfOneNameByTheirPaths) {
  auto made = std::vector{column("Fx", "N", {1, 2}), column("Fy", "N", {3, 4}),
                          column("Fz", "N", {5, 6}), column("Fx", "N", {7, 8}),
                          column("time_s", "", {0, 1})};
  made[0].column.path = "first/Fx";
  made[1].column.path = "first/Fy";
  made[3].column.path = "second/Fx";
  EXPECT_EQ(refusal(made),
            "r.bin: no column is named Fx, for example Fx_N: the columns are "
            "\"first/Fx\", \"Fy\", \"Fz\", \"second/Fx\", \"time_s\"; columns = [...] "
            "in [[measurement]] names the three forces\n");
  RecordSource m;
  m.columns = {"second/Fx", "first/Fy", "Fz"};
  const auto record = record_of(table_of(made), "r.bin", m);
  EXPECT_EQ(record.channel[0][0], 7.0);
  EXPECT_EQ(record.channel[1][0], 3.0);
}

TEST(RecordNumeric, RefusesWhatIsNoRecord) {
  const std::vector<double> two{1, 2};
  EXPECT_EQ(refusal({}), "r.bin: the file has no column of numbers\n");
  EXPECT_EQ(refusal({column("Fx", "N", two), column("Fy", "N", {1, 2, 3}),
                     column("Fz", "N", two), column("t", "s", two)}),
            "r.bin: column \"Fy\" has 3 samples, \"Fx\" has 2: they must be sampled "
            "together\n");
  EXPECT_EQ(
      refusal({column("Fx", "N", two), column("Fy", "N", {1, std::nan("")}),
               column("Fz", "N", two), column("t", "s", two)}),
      "r.bin: column \"Fy\": sample 2 is not a finite number: leave out or repair "
      "the sample\n");
  EXPECT_EQ(
      refusal({column("Fx", "N", two), column("Fy", "N", two), column("Fz", "N", two)}),
      "r.bin: neither angles nor times nor a sampling rate are known: add a "
      "column angle_deg or time_s, or sample_rate_Hz in the case file\n");
  EXPECT_EQ(refusal({column("Fx", "N", two), column("Fy", "N", two),
                     column("Fz", "N", two), column("t", "s", {1, 1})}),
            "r.bin: time 1 s does not come after 1 s of the row before: times must "
            "increase (if they are printed too coarsely, give sample_rate_Hz in the "
            "case file)\n");
}

TEST(RecordNumeric, RefusesTimesThatNoRecordHas) {
  const std::vector<double> two{1, 2};
  EXPECT_EQ(
      refusal({column("Fx", "N", two), column("Fy", "N", two), column("Fz", "N", two),
               column("t", "s", {0, 1e-310})}),
      "r.bin: time 1e-310 s comes after 0 s: no record has more than 1e+09 samples a "
      "second; look at the unit of the times\n");
}

TEST(RecordNumeric, RefusesMoreThanItWouldRead) {
  auto table = table_of({column("Fx", "N", {1, 2}, 1e4), column("Fy", "N", {1, 2}, 1e4),
                         column("Fz", "N", {1, 2}, 1e4)});
  for (auto& c : table.columns) c.count = std::size_t{1} << 40;
  table.values = [](std::size_t) -> std::vector<double> {
    ADD_FAILURE() << "nothing may be read";
    return {};
  };
  EXPECT_THROW(record_of(table, "r.bin", {}), base::InputError);
}

TEST(RecordNumeric, TakesTheAngleFromPulses) {
  const std::vector<double> force(12, 1.0);
  std::vector made{column("Fx", "N", force, 1e3), column("Fy", "N", force, 1e3),
                   column("Fz", "N", force, 1e3),
                   column("index", "V", {0, 5, 0, 0, 0, 5, 0, 0, 0, 5, 0, 0})};
  made[3].column.path = "encoder/index";
  for (const char* name : {"index", "encoder/index"}) {
    RecordSource m;
    m.pulse_column = name;
    const auto record = record_of(table_of(made), "r.bin", m);
    ASSERT_EQ(record.angle.size(), 12u);
    EXPECT_NEAR(record.angle[11] - record.angle[0], unit::turn * 11 / 4, 1e-9);
  }
}

TEST(RecordNumeric, ScalesVoltsToNewtons) {
  const std::vector made{column("Fx", "V", {1, 2}, 1e4),
                         column("Fy", "mV", {3, 4}, 1e4),
                         column("Fz_V", "", {5, 6}, 1e4)};
  EXPECT_NE(
      refusal(made).find("the unit \"V\" of column \"Fx\" is not one of force: N, "
                         "kN, mN, daN or lbf is right, or scale = [...]"),
      std::string::npos);
  RecordSource m;
  m.scale = {500, -500, 1000};
  const auto record = record_of(table_of(made), "r.bin", m);
  EXPECT_EQ(record.channel[0], (std::vector{500.0, 1000.0}));
  EXPECT_EQ(record.channel[1], (std::vector{-1500.0, -2000.0}));
  EXPECT_EQ(record.channel[2], (std::vector{5000.0, 6000.0}));
}

}  // namespace trochoid::files::record_numeric_test
