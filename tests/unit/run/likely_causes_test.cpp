#include <trochoid/run/identify.h>

#include "made_record_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trochoid::run::likely_causes_test {

using namespace test;

constexpr signal::Matrix3 identity = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// A case in memory and its record, channels = Q force.
struct Made {
  cases::Case given;
  std::vector<MeasuredRun> runs;

  explicit Made(const signal::Matrix3& Q) {
    given.setup = identification::without_runout(made_setup());
    given.law = made_law();
    given.identify.chip_models = {chip::Model::feed};
    const auto record = two_turns(0.3, 2.0);
    MeasuredRun run{.file = "record.csv", .run = {record.cut, record.angle, {}}};
    for (const auto& F : record.force) {
      for (std::size_t c = 0; c < 3; ++c) {
        run.run.channel[c].push_back(Q[c][0] * F[0] + Q[c][1] * F[1] + Q[c][2] * F[2]);
      }
    }
    runs.push_back(std::move(run));
  }

  /// Messages, one a line.
  [[nodiscard]] std::string causes() const {
    std::string all;
    for (const auto& w : likely_causes(given, runs, identity, [](const auto&) {})) {
      EXPECT_EQ(w.code, "likely_cause");
      all += w.message + "\n";
    }
    return all;
  }
};

TEST(LikelyCauses, NameTheAxesAloneWhereTheyCureIt) {
  const Made exchanged({{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}});
  const std::string causes = exchanged.causes();
  EXPECT_NE(causes.find("the channels read x, z, y"), std::string::npos) << causes;
  EXPECT_EQ(std::count(causes.begin(), causes.end(), '\n'), 1) << causes;
}

TEST(LookAtChannels, NamesAReadingThatFitsBetter) {
  const auto look = [](const Made& made) {
    return look_at_channels(made.given, made.runs, identity, [](const auto&) {});
  };
  const auto found = look(Made({{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}}));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, "axes_fit_better");
  EXPECT_NE(found[0].message.find("the channels read x, z, y"), std::string::npos);
  EXPECT_TRUE(look(Made(identity)).empty());
  Made searched({{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}});
  searched.given.dynamometer = cases::Dynamometer{.automatic = true};
  EXPECT_TRUE(look(searched).empty());
}

TEST(LookAtCut, NamesTheNumberOfTeeth) {
  Made made(identity);
  EXPECT_TRUE(look_at_cut(made.given, made.runs, identity).empty());
  made.given.setup.cutter.pitch = geometry::equal_pitch(4);
  made.runs[0].run.cut.f_z /= 2;
  const auto found = look_at_cut(made.given, made.runs, identity);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, "cut_fits_better");
  EXPECT_NE(found[0].message.find("with teeth = 2"), std::string::npos)
      << found[0].message;
  EXPECT_NE(found[0].message.find("leaves far less than with 4"), std::string::npos)
      << found[0].message << " (with 4 nothing is explained)";
}

TEST(LookAtCut, NamesADynamometerThatTurnsWithTheSpindle) {
  for (const int times : {1, -1}) {
    Made made(identity);
    auto& run = made.runs[0].run;
    for (std::size_t i = 0; i < run.angle.size(); ++i) {
      const double c = std::cos(times * run.angle[i] + 0.7);
      const double s = std::sin(times * run.angle[i] + 0.7);
      const double x = run.channel[0][i];
      const double y = run.channel[1][i];
      run.channel[0][i] = c * x - s * y;
      run.channel[1][i] = s * x + c * y;
    }
    const auto found = look_at_cut(made.given, made.runs, identity);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NE(
        found[0].message.find(times > 0 ? R"(["u", "-v", "z"])" : R"(["u", "v", "z"])"),
        std::string::npos)
        << found[0].message;
  }
}

TEST(LookAtCut, NamesUpThatWasTakenForDown) {
  Made made(identity);
  made.given.identify.chip_models = {chip::Model::trochoidal};
  force::Setup truth = made_setup();
  truth.cut.engagement = geometry::UpMilling{3.0 * unit::mm};
  const auto record =
      identification::made_record(truth, made_law(), {.per_turn = 180, .turns = 2.0});
  made.runs[0].run.cut = truth.cut;
  made.runs[0].run.cut.engagement = geometry::DownMilling{3.0 * unit::mm};
  for (std::size_t c = 0; c < 3; ++c) {
    made.runs[0].run.channel[c].clear();
    for (const auto& F : record.force) made.runs[0].run.channel[c].push_back(F[c]);
  }
  const auto found = look_at_cut(made.given, made.runs, identity);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].message.find("engagement = \"up\""), std::string::npos)
      << found[0].message;
}

TEST(LikelyCauses, ListTheOthersWhereNoAxesDo) {
  Made made(identity);
  std::string causes = made.causes();
  EXPECT_NE(causes.find("no other reading fits much better"), std::string::npos)
      << causes;
  EXPECT_NE(causes.find("channel_offsets = \"fit\""), std::string::npos);
  EXPECT_NE(causes.find("Tool or cut"), std::string::npos);
  EXPECT_EQ(causes.find("spindle_rpm"), std::string::npos) << "angles were measured";

  made.runs[0].by_time = true;
  made.given.dynamometer = cases::Dynamometer{.automatic = true};
  made.given.identify.channel_offsets = cases::ChannelOffset::fit;
  causes = made.causes();
  EXPECT_NE(causes.find("spindle_rpm = 875"), std::string::npos) << causes;
  EXPECT_EQ(causes.find("axes"), std::string::npos) << "all of them were tried";
  EXPECT_EQ(causes.find("channel_offsets"), std::string::npos);
}

}  // namespace trochoid::run::likely_causes_test
