#include <trochoid/run/records.h>

#include "made_record_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace trochoid::run::records_test {

using namespace test;
using cases::Command;

struct Read {
  std::vector<MeasuredRun> runs;
  std::vector<base::Warning> warnings;
};

Read read(const CaseFolder& folder, const std::string& text) {
  Read out;
  out.runs = measured_runs(folder.read(text, Command::identify), out.warnings);
  return out;
}

TEST(MeasuredRuns, TakeTheAnglesOfTheRecord) {
  const CaseFolder folder;
  const auto record = two_turns();
  folder.write("record.csv", csv_text(record, Axis::angle));
  const Read got = read(folder, cases::test::slot + measurement);
  ASSERT_EQ(got.runs.size(), 1U);
  const MeasuredRun& run = got.runs.front();
  EXPECT_FALSE(run.by_time);
  EXPECT_DOUBLE_EQ(run.Omega, run.run.cut.Omega);
  ASSERT_EQ(run.run.angle.size(), record.angle.size());
  EXPECT_NEAR(run.run.angle.back(), record.angle.back(), 1e-9);
  EXPECT_NEAR(run.run.channel[1][100], record.force[100][1], 1e-6);
  EXPECT_EQ(channels_of(got.runs).front().channel, run.run.channel);
}

TEST(MeasuredRuns, FindTheSpeedOfARecordWithTimes) {
  const CaseFolder folder;
  const auto record = identification::made_record(
      made_setup(), made_law(), {.per_turn = 90, .turns = 20.0, .noise = 1.0});
  folder.write("record.csv", csv_text(record, Axis::time, 880.0));
  const Read got = read(folder, cases::test::slot + measurement);
  ASSERT_EQ(got.runs.size(), 1U);
  EXPECT_TRUE(got.runs[0].by_time);
  EXPECT_NEAR(got.runs[0].Omega / unit::rpm, 880.0, 0.05);
  EXPECT_GT(got.runs[0].Omega_se, 0.0);
  ASSERT_EQ(got.warnings.size(), 1U);
  EXPECT_EQ(got.warnings[0].code, "spindle_speed");
  EXPECT_NE(got.warnings[0].message.find("+0.57 % off the stated 875 rpm"),
            std::string::npos)
      << got.warnings[0].message;
}

TEST(MeasuredRuns, NameASpeedThatIsFarFromTheStatedOne) {
  const CaseFolder folder;
  const auto record = identification::made_record(
      made_setup(), made_law(), {.per_turn = 90, .turns = 20.0, .noise = 1.0});
  folder.write("record.csv", csv_text(record, Axis::time, 1100.0));  // 875 is stated
  const Read got = read(folder, cases::test::slot + measurement);
  ASSERT_EQ(got.warnings.size(), 1U);
  EXPECT_EQ(got.warnings[0].code, "spindle_speed_unknown");
  EXPECT_NE(got.warnings[0].message.find("It repeats at 1100.0 rpm, +26 % off"),
            std::string::npos)
      << got.warnings[0].message;
  EXPECT_DOUBLE_EQ(got.runs[0].Omega / unit::rpm, 875.0);
}

/// Teeth that are alike look periodic at other speeds, too.
TEST(MeasuredRuns, NameTheNearestSpeedThatExplainsAsMuch) {
  const CaseFolder folder;
  force::Setup alike = made_setup();
  alike.runout = {};
  const auto record = identification::made_record(
      alike, made_law(), {.per_turn = 90, .turns = 30.0, .noise = 1.0});
  folder.write("record.csv", csv_text(record, Axis::time, 0.93 * 875.0));
  const Read got = read(folder, cases::test::slot + measurement);
  ASSERT_EQ(got.warnings.size(), 1U);
  EXPECT_NE(got.warnings[0].message.find("-7 % off"), std::string::npos)
      << got.warnings[0].message;
}

TEST(MeasuredRuns, LeaveLostSamplesOut) {
  const CaseFolder folder;
  auto record = identification::made_record(
      made_setup(), made_law(), {.per_turn = 90, .turns = 20.0, .noise = 1.0});
  std::size_t lost = 0;
  for (std::size_t i = 100; i + 20 < record.force.size(); i += 60) {
    for (std::size_t k = 1; k < 12; ++k, ++lost) record.force[i + k] = record.force[i];
  }
  folder.write("record.csv", csv_text(record, Axis::time));
  const Read got = read(folder, cases::test::slot + measurement);
  ASSERT_FALSE(got.warnings.empty());
  EXPECT_EQ(got.warnings[0].code, "dropouts");
  EXPECT_EQ(got.runs[0].run.angle.size(), record.force.size() - lost);
  EXPECT_NEAR(got.runs[0].Omega / unit::rpm, 875.0, 0.1);
}

TEST(MeasuredRuns, RefuseMillisecondsReadAsSeconds) {
  const CaseFolder folder;
  const auto record = identification::made_record(
      made_setup(), made_law(), {.per_turn = 90, .turns = 20.0, .noise = 1.0});
  std::string text = csv_text(record, Axis::time, 875.0 / 1000.0);
  text.replace(0, 6, "Time");
  folder.write("record.csv", text);
  try {
    static_cast<void>(read(folder, cases::test::slot + measurement));
    FAIL() << "taken for seconds";
  } catch (const base::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("in ms 90: write the unit into its name"),
              std::string::npos)
        << error.what();
  }
}

TEST(MeasuredRuns, FollowASpeedThatSags) {
  const CaseFolder folder;
  const auto record = identification::made_record(
      made_setup(), made_law(), {.per_turn = 90, .turns = 60.0, .noise = 1.0});
  auto sagging = record;  // its times are stretched towards the end
  for (double& phi : sagging.angle) phi *= 1.0 + 0.01 * phi / (60.0 * unit::turn);
  folder.write("record.csv", csv_text(sagging, Axis::time));
  const Read got = read(folder, cases::test::slot + measurement);
  ASSERT_FALSE(got.warnings.empty());
  EXPECT_EQ(got.warnings.back().code, "speed_wanders");
  const auto& found = got.runs[0].run.angle;
  ASSERT_EQ(found.size(), record.angle.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    worst = std::max(
        worst, std::abs((found[i] - found[0]) - (record.angle[i] - record.angle[0])));
  }
  EXPECT_LT(worst, 0.02);
}

TEST(MeasuredRuns, SayThatAForceGrows) {
  const CaseFolder folder;
  auto record = identification::made_record(
      made_setup(), made_law(), {.per_turn = 90, .turns = 60.0, .noise = 1.0});
  for (std::size_t i = 0; i < record.force.size(); ++i) {
    for (double& f : record.force[i]) {
      f *= 1.0 +
           0.08 * static_cast<double>(i) / static_cast<double>(record.force.size());
    }
  }
  folder.write("record.csv", csv_text(record, Axis::time));
  const Read got = read(folder, cases::test::slot + measurement);
  ASSERT_EQ(got.warnings.size(), 1U);
  EXPECT_EQ(got.warnings[0].code, "changes_within");
  EXPECT_NE(got.warnings[0].message.find("grows by 8 %"), std::string::npos)
      << got.warnings[0].message;
}

TEST(MeasuredRuns, NameDeadAndClippedChannels) {
  const CaseFolder folder;
  auto record = two_turns();
  for (auto& F : record.force) {
    F[1] = std::min(F[1], 100.0);
    F[2] = 12.5;
  }
  folder.write("record.csv", csv_text(record, Axis::angle));
  const Read got = read(folder, cases::test::slot + measurement);
  ASSERT_EQ(got.warnings.size(), 2U);
  EXPECT_EQ(got.warnings[0].code, "clipped_channel");
  EXPECT_NE(got.warnings[0].message.find("channel 2 (column Fy_N) stays"),
            std::string::npos)
      << got.warnings[0].message;
  EXPECT_EQ(got.warnings[1].code, "dead_channel");
}

TEST(MeasuredRuns, NameTheProblemsOfAllFiles) {
  const CaseFolder folder;
  folder.write("record.csv", "angle_deg,Fx_N\n0,1\n");
  folder.write("other.csv", "angle_deg,Fx_N,Fy_N\n0,1,2\n");
  const std::string other = "[[measurement]]\nfile = \"other.csv\"\n";
  try {
    static_cast<void>(read(folder, cases::test::slot + measurement + other));
    FAIL() << "read what cannot be read";
  } catch (const base::InputError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("record.csv"), std::string::npos) << what;
    EXPECT_NE(what.find("other.csv"), std::string::npos) << what;
  }
}

TEST(MeasuredRuns, RefuseAnAngleThatFalls) {
  const CaseFolder folder;
  folder.write("record.csv",
               "angle_deg,time_s,Fx_N,Fy_N,Fz_N\n"
               "30,0,1,2,3\n20,0.1,1,2,3\n10,0.2,1,2,3\n");
  EXPECT_THROW(static_cast<void>(read(folder, cases::test::slot + measurement)),
               base::InputError);
}

TEST(MeasuredRuns, TakeTheDriftOutWhereTheToolIdles) {
  const CaseFolder folder;
  auto record = identification::made_record(made_setup(), made_law(),
                                            {.per_turn = 180, .turns = 14.0});
  const auto cut = record.force;
  for (std::size_t i = 0; i < record.force.size(); ++i) {
    if (i < 720 || i >= 1800) {  // four turns before the entry, four after the exit
      record.force[i] = {};
    }
    record.force[i][0] += 50.0 + 0.02 * static_cast<double>(i);
  }
  folder.write("record.csv", csv_text(record, Axis::angle));
  const Read got = read(folder, cases::test::slot + measurement +
                                    "[identify]\nchannel_offsets = \"idle\"\n");
  ASSERT_EQ(got.runs.size(), 1U);
  ASSERT_EQ(got.warnings.size(), 1U);
  EXPECT_EQ(got.warnings.front().code, "part_used");
  const auto& angle = got.runs[0].run.angle;
  const auto& channel = got.runs[0].run.channel;
  EXPECT_GE(angle.size(), 800U);  // three quarters of a turn beside air are left out
  EXPECT_LE(angle.size(), 1080U);
  const auto first = static_cast<std::size_t>(std::lround(
      (angle.front() - record.angle[0]) / (record.angle[1] - record.angle[0])));
  EXPECT_GE(first, 720U);
  EXPECT_NEAR(channel[0][77], cut[first + 77][0], 1e-6);
}

/// Two passes with air before, between and behind.
identification::Record two_passes() {
  auto record = identification::made_record(made_setup(), made_law(),
                                            {.per_turn = 180, .turns = 40.0});
  for (std::size_t i = 0; i < record.force.size(); ++i) {
    const std::size_t turn = i / 180;
    if (turn < 5 || (turn >= 15 && turn < 20) || turn >= 35) record.force[i] = {};
  }
  return record;
}

TEST(MeasuredRuns, UseTheLongestSteadyPassAndSaySo) {
  const CaseFolder folder;
  const auto record = two_passes();
  folder.write("record.csv", csv_text(record, Axis::time));
  const Read got = read(folder, cases::test::slot + measurement);
  ASSERT_EQ(got.warnings.size(), 1U) << got.warnings.back().message;
  EXPECT_EQ(got.warnings[0].code, "part_used");
  // 875 rpm: a turn takes 68.6 ms; passes from 0.34 to 1.03 s and from 1.37 to 2.40 s.
  for (const char* part : {"nothing cuts up to 0.274", "from 1.097 s to 1.303 s, from",
                           "the longest of 2 passes", "from_s and to_s"}) {
    EXPECT_NE(got.warnings[0].message.find(part), std::string::npos)
        << got.warnings[0].message;
  }
  EXPECT_NEAR(got.runs[0].Omega / unit::rpm, 875.0, 0.01);
  const double turns =
      (got.runs[0].run.angle.back() - got.runs[0].run.angle.front()) / unit::turn;
  EXPECT_GT(turns, 13.4);
  EXPECT_LT(turns, 15.1);
}

TEST(MeasuredRuns, KeepTheTimesThatAreStated) {
  const CaseFolder folder;
  const auto record = two_passes();
  folder.write("record.csv", csv_text(record, Axis::time));
  const Read got =
      read(folder, cases::test::slot + measurement + "from_s = 0.5\nto_s = 0.9\n");
  EXPECT_TRUE(got.warnings.empty()) << got.warnings.front().message;
  EXPECT_NEAR(static_cast<double>(got.runs[0].run.angle.size()), 0.4 * 875 / 60 * 180,
              2.0);
  for (const char* wrong : {"from_s = 70\n", "from_s = 0.5\nto_s = 0.5\n"}) {
    EXPECT_THROW(
        static_cast<void>(read(folder, cases::test::slot + measurement + wrong)),
        base::InputError);
  }
  folder.write("record.csv", csv_text(record, Axis::angle));
  EXPECT_THROW(
      static_cast<void>(read(folder, cases::test::slot + measurement + "to_s = 0.9\n")),
      base::InputError);
}

TEST(MeasuredRuns, ReadTheOffsetInTheAirUnlessToldOtherwise) {
  const CaseFolder folder;
  auto record = two_passes();
  for (auto& F : record.force) F[2] += 25.0;
  folder.write("record.csv", csv_text(record, Axis::time));
  const std::string text = cases::test::slot + measurement;
  const auto mean = [&](const std::string& more) {
    const auto got = read(folder, text + more);
    const auto& z = got.runs[0].run.channel[2];
    return std::accumulate(z.begin(), z.end(), 0.0) / static_cast<double>(z.size());
  };
  const double kept = mean("[identify]\nchannel_offsets = \"none\"\n");
  EXPECT_NEAR(mean(""), kept - 25.0, 1e-6);
}

TEST(MeasuredRuns, LeaveTheOffsetWhereNothingIsIdle) {
  const CaseFolder folder;
  folder.write("record.csv", csv_text(two_turns(), Axis::angle));
  const Read got = read(folder, cases::test::slot + measurement +
                                    "[identify]\nchannel_offsets = \"idle\"\n");
  ASSERT_EQ(got.warnings.size(), 1U);
  EXPECT_EQ(got.warnings[0].code, "no_idle_part");
}

}  // namespace trochoid::run::records_test
