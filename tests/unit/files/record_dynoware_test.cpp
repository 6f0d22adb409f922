#include <gtest/gtest.h>
#include <trochoid/base/error.h>
#include <trochoid/files/record_file.h>

#include <fmt/core.h>
#include <sstream>

namespace trochoid::files::record_dynoware_test {

struct Export {
  double rate = 10000;
  double first = 2.0;
  int rows = 20;
  long samples = 500001;
  std::string mark = ",";
  std::string end = "\n";
  bool times = true;
};

std::string text(const Export& e) {
  const auto& c = e.mark;
  std::string s =
      "DynoWare" + c + "Version 2.5.1.2\nPath:" + c + "D:\\\nTime:" + c + " \n";
  s += fmt::format("Sampling rate [Hz]:{}{}\nDelay time [s]:{}0\n", c, e.rate, c);
  s += fmt::format("Samples per channel:{}{}\nCycle No:{}1\n", c, e.samples, c);
  s += e.times ? fmt::format("Time{0}Fx{0}Fy{0}Fz\ns{0}N{0}kN{0}N\n", c)
               : fmt::format("Fx{0}Fy{0}Fz\nN{0}kN{0}N\n", c);
  for (int i = 0; i < e.rows; ++i) {
    if (e.times) s += fmt::format("{:.6g}{}", e.first + i / e.rate, c);
    s += fmt::format("{}{}{}{}3.5{}", i, c, 2, c, i + 1 < e.rows ? "\n" : e.end);
  }
  return s;
}

signal::Record read(const std::string& content, const RecordSource& m = {}) {
  std::istringstream in(content);
  return read_record(in, "d.csv", m);
}

std::string refusal(const std::string& content, const RecordSource& m = {}) {
  try {
    read(content, m);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RecordDynoWare, ReadsPartOfARecordAndSaysSo) {
  const auto record = read(text({}));
  ASSERT_EQ(record.size(), 20u);
  EXPECT_EQ(record.sample_rate, 1e4);
  EXPECT_DOUBLE_EQ(record.time[19], 2.0019);
  EXPECT_EQ(record.channel[0][19], 19.0);
  EXPECT_EQ(record.channel[1][0], 2000.0);
  ASSERT_EQ(record.notes.size(), 1u);
  EXPECT_EQ(record.notes[0].code, "part_of_record");
  EXPECT_EQ(record.notes[0].message,
            "The export is a part of its record: 20 of 500001 samples.");
}

TEST(RecordDynoWare, RebuildsTimesThatArePrintedTooCoarsely) {
  // Six digits at 100 s are a millisecond: ten samples show the same time.
  const auto record = read(text({.first = 100.0, .rows = 2000}));
  EXPECT_DOUBLE_EQ(record.time[1], 100.0001);
  EXPECT_DOUBLE_EQ(record.time[1999], 100.1999);
}

TEST(RecordDynoWare, ReadsAWholeRecordWithoutANote) {
  EXPECT_TRUE(read(text({.first = 0.0, .samples = 20})).notes.empty());
}

TEST(RecordDynoWare, ReadsTheFirstPartOfARecordAndSaysSo) {
  const auto record = read(text({.first = 0.0}));
  ASSERT_EQ(record.size(), 20u);
  ASSERT_EQ(record.notes.size(), 1u);
  EXPECT_EQ(
      record.notes[0].message,
      "The export is a part of its record: the first 20 of 500001 samples (or the "
      "file was cut off).");
}

TEST(RecordDynoWare, RefusesMoreRowsThanItsHeaderSays) {
  EXPECT_EQ(refusal(text({.first = 0.0, .samples = 20, .end = ""})), "");
  EXPECT_NE(refusal(text({.samples = 19})).find("19 samples, but 20 rows"),
            std::string::npos);
}

TEST(RecordDynoWare, LeavesOutALastRowWithoutALineEnd) {
  // Its last number may be cut off: 3.5 of 3.57.
  const auto part = read(text({.end = ""}));
  EXPECT_EQ(part.size(), 19u);
  EXPECT_EQ(part.time.size(), 19u);
  ASSERT_EQ(part.notes.size(), 2u);
  EXPECT_EQ(part.notes[0].code, "last_row_left_out");
  EXPECT_EQ(part.notes[1].code, "part_of_record");
  // A whole record has all its rows.
  const auto whole = read(text({.first = 0.0, .samples = 20, .end = ""}));
  EXPECT_EQ(whole.size(), 20u);
  EXPECT_TRUE(whole.notes.empty());
}

TEST(RecordDynoWare, TakesOtherSeparatorsAndNoTimes) {
  EXPECT_EQ(read(text({.mark = ";"})).size(), 20u);
  const auto record = read(text({.mark = "\t", .times = false}));
  EXPECT_EQ(record.size(), 20u);
  EXPECT_DOUBLE_EQ(record.time[10], 1e-3);
}

TEST(RecordDynoWare, TakesTheRateOfTheCaseFileOnlyIfItAgrees) {
  RecordSource m;
  m.sample_rate = 1e4;
  EXPECT_EQ(refusal(text({}), m), "");
  m.sample_rate = 2e4;
  EXPECT_EQ(refusal(text({}), m),
            "d.csv:4:1: the sampling rate here is 10000 Hz, the case file says 20000 "
            "Hz: they must agree\n");
}

}  // namespace trochoid::files::record_dynoware_test
