#include <gtest/gtest.h>
#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/files/record_file.h>
#include <trochoid/files/record_source.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <streambuf>

namespace trochoid::files::record_csv_test {

signal::Record read(const std::string& text, const RecordSource& measurement = {}) {
  std::istringstream in(text);
  return read_record(in, "r.csv", measurement);
}

std::string refusal(const std::string& text, const RecordSource& measurement = {}) {
  try {
    read(text, measurement);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RecordCsv, IsReadInSi) {
  const auto record = read("angle_deg,Fx_N,Fy_N,Fz_N\n0,1.5,-2,+3\n90,4,5e1,.5\n");
  ASSERT_EQ(record.size(), 2u);
  EXPECT_EQ(record.file, "r.csv");
  EXPECT_EQ(record.channel[0], (std::vector{1.5, 4.0}));
  EXPECT_EQ(record.channel[1], (std::vector{-2.0, 50.0}));
  EXPECT_EQ(record.channel[2], (std::vector{3.0, 0.5}));
  EXPECT_EQ(record.angle, (std::vector{0.0, 90 * unit::deg}));
  EXPECT_TRUE(record.time.empty());
  EXPECT_EQ(record.sample_rate, 0.0);
  EXPECT_TRUE(record.notes.empty());
}

TEST(RecordCsv, TakesEverySeparator) {
  for (const std::string mark : {",", ";", "\t"}) {
    const auto record =
        read("angle_deg" + mark + "Fx_N" + mark + "Fy_N" + mark + "Fz_N\n1" + mark +
             "2" + mark + "3" + mark + "4\n2" + mark + "2" + mark + "3" + mark + "4\n");
    EXPECT_EQ(record.channel[2], (std::vector{4.0, 4.0})) << mark;
  }
  EXPECT_EQ(read("sep=;\nangle_deg;Fx_N;Fy_N;Fz_N\n0;1;2;3\n1;1;2;3\n").size(), 2u);
}

/// numpy.savetxt, save -ascii of MATLAB, and tables with names.
TEST(RecordCsv, TakesBlanksBetweenNumbers) {
  const auto named = read("time Fx (N) Fy [N] Fz\n0.0 1.5 -2 3\n1e-3  4\t5e1 .5\n");
  EXPECT_EQ(named.channel[1], (std::vector{-2.0, 50.0}));
  EXPECT_DOUBLE_EQ(named.sample_rate, 1e3);
  const auto bare = read("  0.0e+00 1.5 -2 3\n  1.0e-03 4 5e1 .5\n");
  EXPECT_EQ(bare.channel[0], (std::vector{1.5, 4.0}));
  EXPECT_EQ(bare.time[1], 1e-3);
  ASSERT_FALSE(bare.notes.empty());
  EXPECT_EQ(bare.notes[0].code, "columns_assumed");
}

TEST(RecordCsv, TakesColumnsByTheirNumber) {
  const RecordSource numbers{.columns = {"3", "4", "5"}, .time_column = "2"};
  const auto bare = read("7,0,1,2,3\n7,0.001,4,5,6\n", numbers);
  EXPECT_EQ(bare.channel[0], (std::vector{1.0, 4.0}));
  EXPECT_EQ(bare.time[1], 1e-3);
  const RecordSource few{.columns = {"2", "3", "4"}, .time_column = "1"};
  const auto named =
      read("\xCA\xB1,\xC7\xD0,\xCF\xF7,\xC1\xA6\n0,1,2,3\n0.001,4,5,6\n", few);
  EXPECT_EQ(named.channel[2], (std::vector{3.0, 6.0}));
  EXPECT_NE(refusal("0,1,2,3,4\n1,1,2,3,4\n").find("time_column = \"1\""),
            std::string::npos);
}

TEST(RecordCsv, PassesOverWhatStandsBeforeTheNames) {
  const auto tabs = read(
      "Sample rate:\t1000 Hz\nDate:\t2023-01-01\n\nTime\tFx\tFy\tFz\ns\tN\tkN\tN\n"
      "0\t1\t2\t3\n0.001\t4\t5\t6\n");
  EXPECT_EQ(tabs.channel[1], (std::vector{2e3, 5e3}));
  ASSERT_EQ(tabs.notes.size(), 1u);
  EXPECT_EQ(tabs.notes[0].code, "lines_passed_over");
  const auto semicolons = read(
      "started at: 04.05.2023 12:00:00\nSample rate: 1000\n\n"
      "Time (s);Fx (N);Fy (N);Fz (N)\n0,000;1,5;2;3\n0,001;4;5;6\n");
  EXPECT_EQ(semicolons.channel[0], (std::vector{1.5, 4.0}));
  const auto comment = read(
      "# channels: 4\n# name:  Time  name: Fx name: Fy name: Fz\n"
      "0,1,2,3\n0.001,4,5,6\n");
  EXPECT_EQ(comment.channel[2], (std::vector{3.0, 6.0}));
}

TEST(RecordCsv, TakesTimesOfADay) {
  for (const std::string day : {"", "2023-05-04 ", "04.05.2023T", "5/4/2023 "}) {
    const auto record = read("Time,Fx_N,Fy_N,Fz_N\n" + day + "23:59:59.9990,1,2,3\n" +
                             day + "23:59:59.9995,4,5,6\n");
    ASSERT_EQ(record.size(), 2u) << day;
    EXPECT_NEAR(record.time[1] - record.time[0], 5e-4, 1e-9) << day;
  }
  const auto midnight = read(
      "Time,Fx_N,Fy_N,Fz_N\n2023-12-31 23:59:59.5,1,2,3\n"
      "2024-01-01 00:00:00.0,4,5,6\n");
  EXPECT_NEAR(midnight.time[1] - midnight.time[0], 0.5, 1e-9);
  const RecordSource rated{.sample_rate = 1e3};
  EXPECT_EQ(
      read("Time,Fx_N,Fy_N,Fz_N\n12:00:00,1,2,3\n12:00:00,4,5,6\n", rated).sample_rate,
      1e3);
}

TEST(RecordCsv, ListsTheColumnsWhereNoTimeIsFound) {
  EXPECT_NE(refusal("secs,Fx_N,Fy_N,Fz_N\n0,1,2,3\n1,1,2,3\n")
                .find("time_column there, if that is one of \"secs\""),
            std::string::npos);
  EXPECT_EQ(read("Zeit [s];Fx [N];Fy [N];Fz [N]\n0,0;1;2;3\n0,1;1;2;3\n").size(), 2u);
}

TEST(RecordCsv, FindsTheUnitInTheNameOrBelow) {
  const auto in_name = read("phi [rad];Fx [kN];Fy (N);Fz / mN\n1;2;3;4\n2;2;3;4\n");
  EXPECT_EQ(in_name.channel[0][0], 2e3);
  EXPECT_EQ(in_name.channel[1][0], 3.0);
  EXPECT_EQ(in_name.channel[2][0], 4e-3);
  EXPECT_EQ(in_name.angle[0], 1.0);
  const auto below = read("angle,Fx,Fy,Fz\ndeg,kN,[N],(N)\n180,2,3,4\n181,2,3,4\n");
  EXPECT_EQ(below.channel[0][0], 2e3);
  EXPECT_DOUBLE_EQ(below.angle[0], std::numbers::pi);
  // The degree sign in UTF-8 and in Latin-1, microseconds with the micro sign.
  EXPECT_DOUBLE_EQ(
      read("angle [\xC2\xB0],Fx_N,Fy_N,Fz_N\n180,1,2,3\n1,1,2,3\n").angle[0],
      std::numbers::pi);
  EXPECT_DOUBLE_EQ(read("angle [\xB0],Fx_N,Fy_N,Fz_N\n180,1,2,3\n1,1,2,3\n").angle[0],
                   std::numbers::pi);
  EXPECT_DOUBLE_EQ(read("time_\xC2\xB5s,Fx_N,Fy_N,Fz_N\n1,1,2,3\n2,1,2,3\n").time[1],
                   2e-6);
}

TEST(RecordCsv, SaysWhichUnitItAssumed) {
  const auto record = read("time,Fx,Fy,Fz\n0,1,2,3\n0.1,1,2,3\n");
  ASSERT_EQ(record.notes.size(), 4u);
  EXPECT_EQ(record.notes[0].code, "unit_assumed");
  EXPECT_NE(record.notes[0].message.find("\"Fx\""), std::string::npos);
}

TEST(RecordCsv, FindsColumnsByNameWhateverTheirCaseAndOrder) {
  const auto record = read("FZ_N,comment,TIME_ms,fy_N,F_x_N\n3,a,0,2,1\n3,b,1,2,1\n");
  EXPECT_EQ(record.channel[0][0], 1.0);
  EXPECT_EQ(record.channel[1][0], 2.0);
  EXPECT_EQ(record.channel[2][0], 3.0);
  EXPECT_DOUBLE_EQ(record.time[1], 1e-3);
  EXPECT_DOUBLE_EQ(record.sample_rate, 1e3);
  ASSERT_EQ(record.notes.size(), 1u);
  EXPECT_EQ(record.notes[0].message,
            "Column \"comment\" contains text and is not used.");
}

TEST(RecordCsv, TakesNewtonsPerUnitOfTheCaseFile) {
  RecordSource m;
  m.scale = {500, 500, -1000};
  const auto record = read("time_s,Fx_V,Fy,Fz\ns,V,V,mV\n0,1,2,3\n1,4,5,6\n", m);
  EXPECT_EQ(record.channel[0], (std::vector{500.0, 2000.0}));
  EXPECT_EQ(record.channel[2], (std::vector{-3000.0, -6000.0}));
  EXPECT_TRUE(record.notes.empty()) << "no unit was assumed";
}

TEST(RecordCsv, TakesTheNamesOfTheCaseFile) {
  RecordSource m;
  m.columns = {"F2_N", "f1", "Third [N]"};
  m.angle_column = "theta_deg";
  const auto record =
      read("theta_deg,F1_N,F2_N,Third [N],Fx_N\n0,1,2,3,9\n1,1,2,3,9\n", m);
  EXPECT_EQ(record.channel[0][0], 2.0);
  EXPECT_EQ(record.channel[1][0], 1.0);
  EXPECT_EQ(record.channel[2][0], 3.0);
  EXPECT_DOUBLE_EQ(record.angle[1], unit::deg);
  m.columns = {"F2_N", "F7_N", "Third [N]"};
  EXPECT_EQ(refusal("theta_deg,F1_N,F2_N,Third [N]\n0,1,2,3\n1,1,2,3\n", m),
            "r.csv:1:1: there is no column \"F7_N\": the columns are \"theta_deg\", "
            "\"F1_N\", \"F2_N\", \"Third [N]\"\n");
  m.columns = {"F2_N", "F2_N", "Third [N]"};
  EXPECT_NE(refusal("theta_deg,F1_N,F2_N,Third [N]\n0,1,2,3\n1,1,2,3\n", m)
                .find("three different ones"),
            std::string::npos);
}

TEST(RecordCsv, GoesWithoutAChannelThatIsNotThere) {
  const auto record = read("angle_deg,Fx_N,Fz_N,Mz_Nm\n0,1,3,4\n1,2,5,4\n");
  EXPECT_EQ(record.measured, (std::array{true, false, true}));
  EXPECT_EQ(record.channel[1], (std::vector{0.0, 0.0}));
  EXPECT_EQ(record.channel[2], (std::vector{3.0, 5.0}));
  EXPECT_EQ(record.channel_column[1], "");
  ASSERT_EQ(record.notes.size(), 1U);
  EXPECT_EQ(record.notes[0].code, "channel_missing");
  EXPECT_NE(record.notes[0].message.find("goes without channel 2"), std::string::npos)
      << record.notes[0].message;
  EXPECT_EQ(read("angle_deg,Fy_N\n0,1\n1,2\n").measured,
            (std::array{false, true, false}));
}

TEST(RecordCsv, DoesNotTakeAForceOfAnotherNameForAMissingOne) {
  for (const std::string name : {"Fz1_N", "Fz at 1", "Fz1+2"}) {
    EXPECT_NE(refusal("angle_deg,Fx_N,Fy_N," + name + "\n0,1,2,3\n1,1,2,3\n")
                  .find("no column is named Fz"),
              std::string::npos)
        << name;
  }
}

TEST(RecordCsv, LeavesOutAChannelThatTheCaseFileNamesByNothing) {
  RecordSource m;
  m.columns = {"Fx_N", "", "Fz_N"};
  const auto record = read("angle_deg,Fx_N,Fy_N,Fz_N\n0,1,2,3\n1,1,2,3\n", m);
  EXPECT_EQ(record.measured, (std::array{true, false, true}));
  EXPECT_EQ(record.channel[1], (std::vector{0.0, 0.0}));
  EXPECT_TRUE(record.notes.empty()) << "the case file says so itself";
}

TEST(RecordCsv, PrefersTheForceToTheChannelsOfASimulation) {
  const std::string names =
      "angle_deg,time_s,Fx_N,Fy_N,Fz_N,channel1_N,channel2_N,channel3_N\n";
  const auto both = read(names + "0,0,1,2,3,4,5,6\n1,1,1,2,3,4,5,6\n");
  EXPECT_EQ(both.channel[0][0], 1.0);
  const auto channels =
      read("angle_deg,channel1_N,channel2_N,channel3_N\n0,4,5,6\n1,4,5,6\n");
  EXPECT_EQ(channels.channel[2][0], 6.0);
}

TEST(RecordCsv, TakesTheAngleFromPulses) {
  RecordSource m;
  m.pulse_column = "index";
  std::string text = "time_s,Fx_N,Fy_N,Fz_N,index_V,angle_deg\n";
  for (int i = 0; i < 100; ++i) {
    text += std::to_string(i * 0.001) + ",1,2,3," + (i % 20 == 10 ? "5" : "0") + ",0\n";
  }
  const auto record = read(text, m);
  ASSERT_EQ(record.angle.size(), 100u);
  EXPECT_NEAR(record.angle[50] - record.angle[30], unit::turn, 1e-9);
  EXPECT_NEAR(record.angle[10], unit::turn * 0.5 / 20, 1e-9);
  EXPECT_EQ(record.angle_column, "index_V");
  ASSERT_EQ(record.notes.size(), 1u);
  EXPECT_EQ(
      record.notes[0].message,
      "5 pulses were found in column \"index_V\"; the spindle turns at 3000.00 to "
      "3000.00 rpm by them.");
  m.pulse_column = "Fx_N";
  EXPECT_EQ(refusal(text, m),
            "r.csv: the pulses of column \"Fx_N\": it has 0 rising edges: at least 3 "
            "pulses are needed\n");
  m.pulse_column = "marker";
  EXPECT_NE(refusal(text, m).find("there is no column \"marker\""), std::string::npos);
}

TEST(RecordCsv, LeavesTheAngleToWhomNamesATime) {
  RecordSource m;
  m.time_column = "time_s";
  const auto record =
      read("angle_deg,time_s,Fx_N,Fy_N,Fz_N\n0,0,1,2,3\n1,1,1,2,3\n", m);
  EXPECT_TRUE(record.angle.empty());
  EXPECT_EQ(record.time.size(), 2u);
}

TEST(RecordCsv, SkipsCommentsBlanksByteOrderMarkAndCarriageReturns) {
  const auto record = read(
      "\xEF\xBB\xBF# made by hand\r\n\r\nangle_deg,Fx_N,Fy_N,Fz_N\r\n# "
      "go\r\n0,1,2,3\r\n"
      "   \r\n1, 1 ,\t2,3\r\n#end");
  EXPECT_EQ(record.size(), 2u);
  EXPECT_EQ(record.channel[2], (std::vector{3.0, 3.0}));
}

TEST(RecordCsv, ReadsQuotedFieldsAndSeparatorsAtTheEnd) {
  const auto record = read(
      "\"angle_deg\",\"Fx_N\",\"Fy_N\",\"Fz_N\",\"note, free\",\n"
      "0,\"1.5\",2,3,\"a, b\",\n1,\"1.5\",2,3,,\n");
  EXPECT_EQ(record.channel[0], (std::vector{1.5, 1.5}));
}

TEST(RecordCsv, TakesDecimalCommasOnlyWhereNothingElseCanBeMeant) {
  const auto record =
      read("time_s;Fx_N;Fy_N;Fz_N\n0,000;1,234;-2,5;3\n0,001;1,234;2;3\n");
  EXPECT_EQ(record.channel[0][0], 1.234);
  EXPECT_EQ(record.channel[1][0], -2.5);
  EXPECT_DOUBLE_EQ(record.time[1], 1e-3);
  // 0,500 cannot be thousands, 1234,567 and 1,2345 neither; 1,234 can.
  EXPECT_EQ(refusal("angle_deg;Fx_N;Fy_N;Fz_N\n0;1,2345;2;3\n1;1;2;3\n"), "");
  EXPECT_EQ(refusal("angle_deg;Fx_N;Fy_N;Fz_N\n0;0,500;2;3\n1;1;2;3\n"), "");
  EXPECT_EQ(refusal("angle_deg;Fx_N;Fy_N;Fz_N\n0;1234,567;2;3\n1;1;2;3\n"), "");
  EXPECT_NE(refusal("angle_deg;Fx_N;Fy_N;Fz_N\n0;1,234;2;3\n1;1;2;3\n"), "");
  EXPECT_NE(refusal("angle_deg;Fx_N;Fy_N;Fz_N\n0;1,234,567;2;3\n1;1;2;3\n"), "");
  EXPECT_NE(refusal("angle_deg;Fx_N;Fy_N;Fz_N\n0;0,5;2;3\n1;1.5;2;3\n"), "");
}

TEST(RecordCsv, RebuildsTheTimeFromTheSamplingRate) {
  RecordSource m;
  m.sample_rate = 12800.0;
  std::string text = "time_s,Fx_N,Fy_N,Fz_N\n";
  for (int i = 0; i < 300; ++i) {  // printed to a tenth of a millisecond
    text += std::to_string(100.0 + i / 12800.0).substr(0, 8) + ",1,2,3\n";
  }
  const auto record = read(text, m);
  EXPECT_EQ(record.sample_rate, 12800.0);
  EXPECT_DOUBLE_EQ(record.time[299], 100.0 + 299 / 12800.0);
  // Without the rate the times repeat.
  EXPECT_NE(refusal(text).find("give sample_rate_Hz"), std::string::npos);
  m.sample_rate = 12000.0;
  EXPECT_NE(refusal(text, m).find("sampling rate is wrong"), std::string::npos);
}

TEST(RecordCsv, RefusesADroppedRow) {
  RecordSource m;
  m.sample_rate = 1000.0;
  EXPECT_EQ(
      refusal("time_s,Fx_N,Fy_N,Fz_N\n0.000,1,2,3\n0.001,1,2,3\n0.003,1,2,3\n", m),
      "r.csv:4:1: time 0.003 s where 0.002 s should stand at 1000 Hz: rows are "
      "missing or doubled, or the sampling rate is wrong\n");
}

TEST(RecordCsv, KnowsTheRateOfEvenTimesOnly) {
  EXPECT_DOUBLE_EQ(
      read("time_s,Fx_N,Fy_N,Fz_N\n0,1,2,3\n0.01,1,2,3\n0.02,1,2,3\n").sample_rate,
      100.0);
  EXPECT_EQ(
      read("time_s,Fx_N,Fy_N,Fz_N\n0,1,2,3\n0.01,1,2,3\n0.03,1,2,3\n0.031,1,2,3\n")
          .sample_rate,
      0.0);
}

TEST(RecordCsv, ShowsAtMostFiftyProblemsAndCountsTheRest) {
  std::string text = "angle_deg,Fx_N,Fy_N,Fz_N\n";
  for (int i = 0; i < 70; ++i) text += "0,1,2,x" + std::to_string(i) + "\n";
  const auto said = refusal(text);
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 51);
  EXPECT_NE(said.find("and 20 more\n"), std::string::npos);
}

TEST(RecordCsv, ShowsEqualProblemsFiveTimes) {
  std::string text = "angle_deg,Fx_N,Fy_N,Fz_N\n";
  for (int i = 0; i < 70; ++i) text += i == 60 ? "0,1,2,x\n" : "0,1,2\n";
  const auto said = refusal(text);
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 7);
  EXPECT_NE(said.find("r.csv:6:1: the row has 3 fields"), std::string::npos);
  EXPECT_EQ(said.find("r.csv:7:1: "), std::string::npos);
  EXPECT_NE(said.find("r.csv:62:7: "), std::string::npos)
      << "another one is not hidden";
  EXPECT_NE(said.find("and 64 more\n"), std::string::npos);
}

TEST(RecordCsv, SaysWhereTheTimesHaveAGap) {
  std::string text = "time_s,Fx_N,Fy_N,Fz_N\n";
  const auto add = [&](double t) { text += std::to_string(t) + ",1,2,3\n"; };
  for (int i = 0; i < 50; ++i) add(0.01 * i + (i % 2 == 0 ? 0.0 : 0.003));
  EXPECT_TRUE(read(text).notes.empty()) << "uneven, but nothing is missing";
  add(0.80);
  add(0.81);
  const auto record = read(text);
  ASSERT_EQ(record.notes.size(), 1u);
  EXPECT_EQ(record.notes[0].code, "time_gap");
  EXPECT_NE(record.notes[0].message.find("1 gap: "), std::string::npos);
  EXPECT_NE(record.notes[0].message.find("0.493 s to 0.8 s"), std::string::npos)
      << record.notes[0].message;
}

TEST(RecordCsv, RemembersWhichColumnsItTook) {
  const auto record = read("t_s;Fz_N;Fy_N;Fx_N\n0;1;2;3\n1;1;2;3\n");
  EXPECT_EQ(record.channel_column,
            (std::array<std::string, 3>{"Fx_N", "Fy_N", "Fz_N"}));
  EXPECT_EQ(record.time_column, "t_s");
  EXPECT_EQ(record.angle_column, "");
}

/// Gives one endless line and counts what is taken of it.
class EndlessLine : public std::streambuf {
 public:
  std::size_t taken = 0;

 protected:
  std::streamsize xsgetn(char* to, std::streamsize n) override {
    std::fill_n(to, n, '7');
    taken += static_cast<std::size_t>(n);
    return n;
  }
  int_type underflow() override {
    ++taken;
    return '7';
  }
  pos_type seekpos(pos_type to, std::ios_base::openmode /*which*/) override {
    return to;
  }
};

TEST(RecordCsv, RefusesAnEndlessLineWithoutReadingIt) {
  EndlessLine line;
  std::istream in(&line);
  std::string said;
  try {
    read_record(in, "r.csv", {});
  } catch (const base::InputError& error) {
    said = error.what();
  }
  EXPECT_EQ(said,
            "r.csv:1:65537: the line is longer than 65536 bytes: a record has one "
            "sample a line\n");
  EXPECT_LT(line.taken, std::size_t{1} << 20);
}

TEST(RecordCsv, OpensRegularFilesOnly) {
  RecordSource m;
  m.file.location = "case.toml:7:8";
  for (const char* name : {"/dev/zero", "/", "/no/such/file"}) {
    m.file.path = name;
    try {
      read_record(m);
      ADD_FAILURE() << name;
    } catch (const base::InputError& error) {
      EXPECT_EQ(std::string(error.what()).rfind("case.toml:7:8: file = ", 0), 0u);
    }
  }
}

TEST(RecordCsv, RefusesAnotherFormatThanTheCaseFileSays) {
  RecordSource m;
  m.format = RecordFormat::dynoware;
  EXPECT_NE(refusal("angle_deg,Fx_N,Fy_N,Fz_N\n0,1,2,3\n1,1,2,3\n", m), "");
  m.format = RecordFormat::csv;
  EXPECT_EQ(refusal("angle_deg,Fx_N,Fy_N,Fz_N\n0,1,2,3\n1,1,2,3\n", m), "");
  EXPECT_NE(refusal("DynoWare,Version 2\nSampling rate [Hz]:,1\nFx,Fy,Fz\n", m), "");
}

}  // namespace trochoid::files::record_csv_test
