#include "from_bytes.h"

#include <gtest/gtest.h>
#include <trochoid/files/record_source.h>

namespace trochoid::files::record_lvm_test {

constexpr RecordFrom read{"r.lvm"};
constexpr RefusalFrom refusal{"r.lvm"};

/// As LabVIEW writes it: lines end with CR LF, and heads are padded with tabs.
std::string head(const std::string& x_columns = "One",
                 const std::string& decimal = ".") {
  return "LabVIEW Measurement\t\r\nWriter_Version\t2\r\nReader_Version\t2\r\n"
         "Separator\tTab\r\nDecimal_Separator\t" +
         decimal + "\r\nMulti_Headings\tYes\r\nX_Columns\t" + x_columns +
         "\r\nTime_Pref\tAbsolute\r\nOperator\tme\r\nDate\t2020/01/01\r\n"
         "***End_of_Header***\t\r\n\t\r\n";
}

std::string segment(const std::string& step = "1.000000E-4") {
  return "Channels\t3\t\t\t\r\nSamples\t2\t2\t2\t\r\nDate\t2020/01/01\t2020/01/01\t\r\n"
         "Time\t12:00:00\t12:00:00\t12:00:00\t\r\nY_Unit_Label\tN\tkN\tNewtons\t\r\n"
         "X_Dimension\tTime\tTime\tTime\t\r\nX0\t5.0E-1\t5.0E-1\t5.0E-1\t\r\nDelta_X\t" +
         step + "\t" + step + "\t" + step + "\t\r\n***End_of_Header***\t\t\t\t\r\n";
}

TEST(RecordLvm, ReadsUnitsTimesAndForces) {
  const auto record = read(head() + segment() +
                           "X_Value\tFx\tFy\tFz\tComment\r\n"
                           "0.500000\t1.5\t2\t-3\tgo\r\n0.500100\t4\t5E-1\t6\r\n");
  EXPECT_EQ(record.channel[0], (std::vector{1.5, 4.0}));
  EXPECT_EQ(record.channel[1], (std::vector{2e3, 500.0}));
  EXPECT_EQ(record.channel[2], (std::vector{-3.0, 6.0}));
  EXPECT_DOUBLE_EQ(record.sample_rate, 1e4);
  EXPECT_DOUBLE_EQ(record.time[1], 0.5001);
  EXPECT_TRUE(record.notes.empty());
}

TEST(RecordLvm, TakesTimesBeforeEachChannelOrNone) {
  const auto multi =
      read(head("Multi") + segment() +
           "X_Value\tFx\tX_Value\tFy\tX_Value\tFz\tComment\r\n"
           "0.5\t1\t0.5\t2\t0.5\t3\t\r\n0.5001\t4\t0.5001\t5\t0.5001\t6\r\n");
  EXPECT_EQ(multi.channel[2], (std::vector{3.0, 6.0}));
  const auto none = read(head("No") + segment() +
                         "X_Value\tFx\tFy\tFz\tComment\r\n\t1\t2\t3\r\n\t4\t5\t6\r\n");
  EXPECT_EQ(none.channel[0], (std::vector{1.0, 4.0}));
  EXPECT_DOUBLE_EQ(none.time[0], 0.5);
}

TEST(RecordLvm, TakesItsTimesWhereThereIsNoStep) {
  const auto record = read(head() + segment("0") +
                           "X_Value\tFx\tFy\tFz\r\n0.25\t1\t2\t3\r\n0.75\t4\t5\t6\r\n");
  EXPECT_EQ(record.time, (std::vector{0.25, 0.75}));
  EXPECT_DOUBLE_EQ(record.sample_rate, 2.0);
}

TEST(RecordLvm, TakesTheDecimalSeparatorOfItsHead) {
  const std::string rows =
      "X_Value\tFx\tFy\tFz\r\n0,5\t1,500\t2\t3\r\n0,6\t1,501\t2\t3\r\n";
  EXPECT_EQ(read(head("One", ",") + segment("1E-4") + rows).channel[0][0], 1.5);
  EXPECT_NE(refusal(head() + segment() + rows).find("with a decimal point"),
            std::string::npos);
}

TEST(RecordLvm, ReadsTheFirstOfSeveralSegmentsAndSaysSo) {
  const std::string rows = "X_Value\tFx\tFy\tFz\r\n0.5\t1\t2\t3\r\n0.5001\t4\t5\t6\r\n";
  const auto record = read(head() + segment() + rows + "\r\n" + segment() + rows);
  EXPECT_EQ(record.size(), 2u);
  ASSERT_EQ(record.notes.size(), 1u);
  EXPECT_EQ(record.notes[0].message,
            "The file has several segments: the first one is read, 2 samples.");
}

TEST(RecordLvm, IsCutOffNowhereWithoutAWord) {
  const auto text = head() + segment() +
                    "X_Value\tFx\tFy\tFz\r\n0.5\t1\t2\t3\r\n0.5001\t4\t5\t67\r\n";
  EXPECT_EQ(refusal(text), "");
  for (int tenth = 1; tenth < 10; ++tenth) {
    const auto part =
        text.substr(0, text.size() * static_cast<std::size_t>(tenth) / 10);
    EXPECT_NE(refusal(part).find("cut off"), std::string::npos) << refusal(part);
  }
}

TEST(RecordLvm, IsRefusedUnderAnotherName) {
  RecordSource m;
  m.format = RecordFormat::tdms;
  EXPECT_EQ(refusal(head() + segment(), m),
            "r.lvm:1:1: this is a LabVIEW measurement file, but the case file says "
            "format = \"tdms\": \"lvm\" is right\n");
}

}  // namespace trochoid::files::record_lvm_test
