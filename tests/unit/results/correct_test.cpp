#include <trochoid/results/correct.h>

#include "answers.h"

#include <trochoid/base/units.h>

#include <gtest/gtest.h>

namespace trochoid::results::correct_test {

using correction::Correction;
using test::column_of;
using test::columns_of;
using test::json_at;
using test::table_of;
using Names = std::vector<std::string>;

/// Two teeth, one tool mode before the table, two samples.
correction::MovedCut moved(double peak_of_second) {
  correction::MovedCut cut;
  cut.motion = {.time = {0.5, 0.51},
                .angle = {unit::turn, unit::turn + unit::deg},
                .force = {{1, 2, 3}, {4, 5, 6}},
                .mode = {{0, 0}, {1 * unit::um, 2 * unit::um}},
                .flutes = {{40, 50, 1e-3, 1e-5}, {30, peak_of_second, 1e-3, 2e-5}},
                .last_change = 0.5};
  cut.walls = {
      {.exit = true, .marks = {.peak_to_valley = 0.3 * unit::um, .share = {1.0, 0.0}}}};
  return cut;
}

CorrectResult result() {
  CorrectResult r{.heading = {.title = "a */ title"}};
  r.heading.ok = true;
  r.options.allowed_difference = 0.07;
  Correction& c = r.correction;
  c.ok = c.setting.ok = c.plan.ok = true;
  c.setting.rho = {10 * unit::um, -10 * unit::um};
  c.setting.designed_for = {9 * unit::um, -9 * unit::um};
  c.setting.angle_offset = 5 * unit::deg;
  c.setting.cut.setup.cut.Omega = 1200 * unit::rpm;
  c.setting.cut.tool.resize(1);
  c.plan.motion = correction::Harmonics{.c = {10 * unit::um}};
  c.plan.command = {
      .ok = true, .wave = correction::Harmonics{.c = {15 * unit::um}}, .n_max = 1};
  c.plan.limits.offset = 30 * unit::um;
  c.plan.limits.limits = {{.kind = correction::LimitKind::stroke,
                           .value = 30 * unit::um,
                           .limit = 60 * unit::um,
                           .margin = 30 * unit::um,
                           .reason = "a stroke"},
                          {.kind = correction::LimitKind::slew,
                           .value = 2000 * unit::um,
                           .known = false,
                           .reason = "not known"}};
  c.cuts = {.before = moved(25), .after = moved(50), .table_deviation = 2 * unit::um};
  c.speeds = {
      .Omega = {1000 * unit::rpm, 2000 * unit::rpm},
      .curves = {{.name = "this_case",
                  .points = {{.peak_difference = 0.1, .command_range = 30 * unit::um},
                             {.peak_difference = 0.2, .command_range = 31 * unit::um}},
                  .chosen = {{40 * unit::deg, 7}, {60 * unit::deg, 3}},
                  .highest = 1500 * unit::rpm}}};
  c.axes = {12 * unit::um, 3 * unit::um, 1 * unit::um, 2};
  return r;
}

correction::ControllerInLoop controller() {
  correction::ControllerInLoop loop{.ok = true};
  loop.turns.resize(7, {.peaks = {50, 25}, .difference = 0.5});
  loop.turns.back() = {
      .peaks = {50, 49}, .difference = 0.02, .gain = 1.1, .state = TROCHOID_RUNNING};
  loop.samples = {{0.0, 30 * unit::um, 1 * unit::um, 1.0, TROCHOID_DISABLED},
                  {0.1, 35 * unit::um, 2 * unit::um, 1.1, TROCHOID_RUNNING}};
  loop.lowest = 15 * unit::um;
  loop.highest = 45 * unit::um;
  return loop;
}

TEST(CorrectAnswer, TablesCarryNamesAndUnits) {
  const Answer answer = answer_of(result());
  EXPECT_EQ(answer.command, "correct");
  const base::Table& command = table_of(answer, "command.csv");
  EXPECT_EQ(columns_of(command), (Names{"angle_deg", "command_um", "table_wanted_um"}));
  ASSERT_EQ(column_of(command, "angle_deg").size(), 720U);
  EXPECT_EQ(column_of(command, "angle_deg")[180], 90.0);
  EXPECT_DOUBLE_EQ(column_of(command, "command_um")[0], 45.0);
  EXPECT_DOUBLE_EQ(column_of(command, "table_wanted_um")[360], 20.0);
  const base::Table& forces = table_of(answer, "forces.csv");
  EXPECT_EQ(columns_of(forces),
            (Names{"angle_deg", "time_s", "Fx_before_N", "Fy_before_N", "Fz_before_N",
                   "table_before_um", "Fx_after_N", "Fy_after_N", "Fz_after_N",
                   "table_after_um"}));
  EXPECT_NEAR(column_of(forces, "angle_deg")[1], 1.0, 1e-9) << "from the turn's start";
  EXPECT_NEAR(column_of(forces, "time_s")[1], 0.01, 1e-12);
  EXPECT_DOUBLE_EQ(column_of(forces, "Fy_before_N")[1], 5.0);
  EXPECT_DOUBLE_EQ(column_of(forces, "table_after_um")[1], 2.0);
  const base::Table& speeds = table_of(answer, "speeds.csv");
  EXPECT_EQ(columns_of(speeds),
            (Names{"spindle_rpm", "this_case_difference", "this_case_command_um",
                   "this_case_transition_deg", "this_case_harmonics"}));
  EXPECT_DOUBLE_EQ(column_of(speeds, "this_case_transition_deg")[1], 60.0);
  EXPECT_DOUBLE_EQ(column_of(speeds, "this_case_harmonics")[0], 7.0);
  EXPECT_DOUBLE_EQ(column_of(speeds, "this_case_command_um")[1], 31.0);
  EXPECT_EQ(answer.tables.size(), 3U) << "no controller, no table of it";
}

TEST(CorrectAnswer, SaysWhatIsThereAndWhatIsLeft) {
  const Answer answer = answer_of(result());
  EXPECT_EQ(json_at(answer, "runout", "chip_difference_um"), "[20, -20]");
  EXPECT_EQ(json_at(answer, "runout", "designed_for_um"), "[18, -18]");
  EXPECT_EQ(json_at(answer, "runout", "static_fit"), "") << "there is none";
  EXPECT_EQ(json_at(answer, "runout", "ratio_um"), "");
  EXPECT_EQ(json_at(answer, "runout", "angle_offset_deg"), "5");
  EXPECT_EQ(json_at(answer, "before", "difference"), "0.5");
  EXPECT_EQ(json_at(answer, "after", "difference"), "0");
  EXPECT_EQ(json_at(answer, "after", "area_difference"), "0");
  EXPECT_EQ(json_at(answer, "before", "periodic"), "true");
  EXPECT_EQ(json_at(answer, "reduction"), "1");
  EXPECT_EQ(json_at(answer, "allowed_difference"), "0.07");
  EXPECT_EQ(json_at(answer, "max_rpm", "this_case"), "1500");
  EXPECT_EQ(json_at(answer, "axes", "most_teeth_in_cut"), "2");
  EXPECT_EQ(json_at(answer, "controller"), "");
  EXPECT_NE(answer.short_table.find(
                "difference of the peaks: 50.00 % before, 0.00 % after\n"),
            std::string::npos)
      << answer.short_table;
}

TEST(CorrectAnswer, SaysWhatTheActuatorIsTold) {
  CorrectResult r = result();
  Answer answer = answer_of(r);
  EXPECT_EQ(json_at(answer, "command", "peak_to_peak_um"), "30");
  EXPECT_EQ(json_at(answer, "command", "motion_peak_to_peak_um"), "20");
  EXPECT_EQ(json_at(answer, "command", "stroke_margin_um"), "30");
  EXPECT_DOUBLE_EQ(std::stod(json_at(answer, "command", "slew_um_per_s")), 2000.0);
  EXPECT_EQ(json_at(answer, "command", "harmonics"), "1");
  EXPECT_EQ(json_at(answer, "command", "learning"), "");
  r.correction.plan.command.n_max = 0;
  r.correction.plan.learned =
      correction::Learned{.error = {2 * unit::um, 1 * unit::um}, .iterations = 1};
  answer = answer_of(r);
  EXPECT_EQ(json_at(answer, "command", "harmonics"), "null") << "all";
  EXPECT_EQ(json_at(answer, "command", "learning", "iterations"), "1");
  EXPECT_EQ(json_at(answer, "command", "learning", "error_um"), "[2, 1]");
}

TEST(CorrectAnswer, SaysHowTheRunoutWasRead) {
  CorrectResult r = result();
  r.correction.setting.fit = correction::StaticFit{
      .ok = true, .h_ro = {{18 * unit::um, 1e-7}, {-18 * unit::um, 1e-7}}, .rms = 0.4};
  r.correction.setting.ratio =
      correction::RatioEstimate{.ok = false, .reason = "flute 2 is not cutting"};
  const Answer answer = answer_of(r);
  EXPECT_EQ(json_at(answer, "runout", "static_fit", "rms_N"), "0.4");
  EXPECT_EQ(json_at(answer, "runout", "ratio_um"), "null");
  EXPECT_EQ(json_at(answer, "runout", "ratio_reason"), "\"flute 2 is not cutting\"");
  EXPECT_NE(answer.short_table.find("tooth 1 cuts 20.00 um more than the feed; a rigid "
                                    "model reads 18.00 um from the forces\n"),
            std::string::npos)
      << answer.short_table;
}

TEST(CorrectAnswer, ALimitThatIsBrokenIsMarked) {
  CorrectResult r = result();
  r.correction.plan.limits.limits[0].ok = false;
  const std::string text = answer_of(r).short_table;
  EXPECT_NE(text.find("  BEYOND: a stroke\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  not known\n"), std::string::npos) << "it is not broken";
}

TEST(CorrectAnswer, TheControllerHasItsOwnTable) {
  CorrectResult r = result();
  r.correction.controller = controller();
  const Answer answer = answer_of(r);
  const base::Table& samples = table_of(answer, "controller.csv");
  EXPECT_EQ(columns_of(samples),
            (Names{"time_s", "command_um", "table_um", "gain", "state"}));
  EXPECT_DOUBLE_EQ(column_of(samples, "command_um")[1], 35.0);
  EXPECT_EQ(json_at(answer, "controller", "difference_before"), "0.5");
  EXPECT_EQ(json_at(answer, "controller", "difference_running"), "0.02");
  EXPECT_EQ(json_at(answer, "controller", "turns_to_3_percent"), "1");
  EXPECT_EQ(json_at(answer, "controller", "gain"), "1.1");
  EXPECT_EQ(json_at(answer, "controller", "highest_um"), "45");
  EXPECT_EQ(json_at(answer, "controller", "fault"), "null");
  EXPECT_EQ(json_at(answer, "controller", "time_to_safe_s"), "null");
  EXPECT_NE(answer.short_table.find("controller: 50.00 % before, 2.00 % running; "
                                    "command within 15.00 and 45.00 um\n"),
            std::string::npos)
      << answer.short_table;
}

TEST(CorrectAnswer, AFaultOfTheControllerIsNamed) {
  CorrectResult r = result();
  r.correction.controller = controller();
  r.correction.controller->fault = TROCHOID_INDEX_LOST;
  r.correction.controller->fault_time = 0.4;
  r.correction.controller->turns.back().state = TROCHOID_FAULT;
  Answer answer = answer_of(r);
  EXPECT_EQ(json_at(answer, "controller", "fault"), "\"no index pulse\"");
  EXPECT_EQ(json_at(answer, "controller", "difference_running"), "null");
  EXPECT_NE(
      answer.short_table.find("never running; fault \"no index pulse\" at 0.400 s, "
                              "not yet at mid-stroke\n"),
      std::string::npos)
      << answer.short_table;
  r.correction.controller->time_to_safe = 0.05;
  answer = answer_of(r);
  EXPECT_EQ(json_at(answer, "controller", "time_to_safe_s"), "0.05");
}

TEST(CorrectAnswer, TheHeaderIsForAProgramInC) {
  const Answer answer = answer_of(result());
  ASSERT_EQ(answer.texts.size(), 1U);
  EXPECT_EQ(answer.texts[0].file, "command.h");
  const std::string& header = answer.texts[0].text;
  for (const char* line :
       {"#define TROCHOID_COMMAND_POINTS 720\n", "trochoid_command_rpm = 1200;\n",
        "trochoid_command_offset_deg = 5;\n", "trochoid_command_middle_um = 30;\n",
        "trochoid_command_um[TROCHOID_COMMAND_POINTS] = {\n    45.0000,"}) {
    EXPECT_NE(header.find(line), std::string::npos) << line;
  }
  EXPECT_EQ(header.find("*/ title"), std::string::npos) << "it would end the comment";
}

TEST(CorrectAnswer, OfWhatFailedIsItsMessageAlone) {
  CorrectResult r = result();
  r.correction.ok = r.heading.ok = false;
  r.heading.message = "the teeth stand out alike: there is nothing to correct";
  const Answer answer = answer_of(r);
  EXPECT_EQ(answer.heading.message, r.heading.message);
  EXPECT_TRUE(answer.tables.empty());
  EXPECT_TRUE(answer.texts.empty());
  EXPECT_TRUE(answer.short_table.empty());
  EXPECT_EQ(json_text(answer.result), "{}");
}

TEST(CorrectAnswer, KeepsItsNumbersWhereTheControllerRefuses) {
  CorrectResult r = result();
  r.heading.ok = false;
  r.correction.controller = correction::ControllerInLoop{.reason = "refused"};
  const Answer answer = answer_of(r);
  EXPECT_EQ(json_at(answer, "controller"), "");
  EXPECT_EQ(json_at(answer, "reduction"), "1");
  EXPECT_EQ(answer.tables.size(), 3U);
}

}  // namespace trochoid::results::correct_test
