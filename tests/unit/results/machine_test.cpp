#include "answers.h"

#include <trochoid/base/units.h>
#include <trochoid/results/actuator.h>
#include <trochoid/results/modes.h>

#include <gtest/gtest.h>

namespace trochoid::results::machine_test {

using structure::ResponseKind;
using test::column_of;
using test::columns_of;
using test::json_at;
using test::table_of;
using Names = std::vector<std::string>;

ModesResult modes_result() {
  ModesResult r{.body = structure::ModeBody::table};
  r.responses = {{.motion = structure::Axis::y, .force = structure::Axis::y}};
  structure::FittedMode mode{
      .omega = {1500 * unit::Hz}, .zeta = {0.02}, .mass = {0.2}, .stiffness = {1.7e7}};
  mode.damping = {80};
  mode.lines_in_peak = 7;
  r.fit = {.ok = true, .modes = {mode}, .real_modes = {mode}};
  r.fit.responses = {{.kind = ResponseKind::accelerance,
                      .omega = {100 * unit::Hz, 200 * unit::Hz},
                      .H = {{1, 2}, {3, 4}},
                      .fitted = {{5, 6}, {7, 8}},
                      .explained = 0.99,
                      .rms = 0.5}};
  return r;
}

TEST(ModesAnswer, NamesTheUnitOfItsKind) {
  const Answer answer = answer_of(modes_result());
  const base::Table& table = table_of(answer, "fitted.csv");
  EXPECT_EQ(columns_of(table),
            (Names{"frequency_Hz", "re_m_per_s2_N", "im_m_per_s2_N",
                   "fitted_re_m_per_s2_N", "fitted_im_m_per_s2_N", "mode_indicator"}));
  EXPECT_EQ(column_of(table, "fitted_im_m_per_s2_N"), (std::vector<double>{6, 8}));
  EXPECT_EQ(json_at(answer, "kind"), "\"accelerance\"");
  EXPECT_EQ(json_at(answer, "rms_m_per_s2_N"), "0.5");
  EXPECT_EQ(json_at(answer, "band_Hz"), "[100, 200]");
  EXPECT_EQ(json_at(answer, "residual_terms"), "null") << "none are needed";
  EXPECT_EQ(json_at(answer, "description"), "") << "the file says none";
  EXPECT_NE(answer.short_table.find("leaves 0.5 m/s^2/N (rms)"), std::string::npos)
      << answer.short_table;
}

TEST(ModesAnswer, WritesModesForOtherCases) {
  const Answer answer = answer_of(modes_result());
  ASSERT_EQ(answer.texts.size(), 1U);
  EXPECT_EQ(answer.texts[0].file, "modes.toml");
  EXPECT_NE(answer.texts[0].text.find("[[mode]]  # 1500 Hz, damping ratio 0.02\n"
                                      "body = \"table\"\naxis = \"y\"\n"
                                      "mass_kg = 0.2  # standard error 0\n"),
            std::string::npos)
      << answer.texts[0].text;
}

TEST(ModesAnswer, WithoutAFitHasNoModes) {
  ModesResult r = modes_result();
  r.fit.ok = false;
  r.fit.responses[0].fitted.clear();
  const Answer answer = answer_of(r);
  EXPECT_EQ(json_at(answer, "modes"), "null");
  EXPECT_EQ(json_at(answer, "explained"), "");
  EXPECT_EQ(columns_of(table_of(answer, "fitted.csv")).size(), 4U);
  EXPECT_TRUE(answer.texts.empty());
  EXPECT_EQ(answer.short_table, "");
}

ActuatorResult actuator_result() {
  ActuatorResult r;
  r.record = {.time = {0.0, 0.1}, .position = {0.0, 5.9e-6}, .step = 6e-6};
  r.command = {0.0, 6e-6};
  r.fit = {.ok = true,
           .dynamics = structure::from_frequency(0.98, 140, 0.6),
           .start = 0.05,
           .start_se = 1e-4,
           .time_constants_reason = "the actuator is underdamped",
           .fitted = {0.0, 5.88e-6}};
  return r;
}

TEST(ActuatorAnswer, TimeConstantsThatAreNotKnownAreNullWithTheReason) {
  const Answer answer = answer_of(actuator_result());
  EXPECT_EQ(json_at(answer, "time_constants_s"), "null");
  EXPECT_EQ(json_at(answer, "se", "time_constants_s"), "null");
  EXPECT_EQ(json_at(answer, "identifiable", "time_constants_s"),
            "\"the actuator is underdamped\"");
  EXPECT_EQ(json_at(answer, "step_um"), "6");
  EXPECT_NE(answer.short_table.find(
                "time constants: not given, the actuator is underdamped\n"),
            std::string::npos);
  EXPECT_NE(answer.short_table.find("start of the step [ms]"), std::string::npos);
}

TEST(ActuatorAnswer, TablesCarryNamesAndUnits) {
  ActuatorResult r = actuator_result();
  const Answer whole = answer_of(r);
  const base::Table& table = table_of(whole, "fitted.csv");
  EXPECT_EQ(columns_of(table),
            (Names{"time_s", "command_um", "position_um", "fitted_um"}));
  EXPECT_EQ(column_of(table, "command_um"), (std::vector<double>{0, 6}));
  r.command.clear();
  r.fit.ok = false;
  const Answer bare = answer_of(r);
  EXPECT_EQ(columns_of(table_of(bare, "fitted.csv")), (Names{"time_s", "position_um"}));
  EXPECT_EQ(json_at(bare, "gain"), "null");
  EXPECT_EQ(json_at(bare, "se"), "");
  EXPECT_TRUE(bare.texts.empty());
}

TEST(ActuatorAnswer, OneThatMovesBackwardsIsNotForOtherCases) {
  ActuatorResult r = actuator_result();
  ASSERT_EQ(answer_of(r).texts.size(), 1U);
  EXPECT_NE(answer_of(r).texts[0].text.find("[actuator]\ngain = 0.98"),
            std::string::npos);
  r.fit.dynamics.gain = -0.98;
  EXPECT_TRUE(answer_of(r).texts.empty());
}

}  // namespace trochoid::results::machine_test
