#include "answers.h"

#include <trochoid/base/units.h>
#include <trochoid/results/dynamics.h>
#include <trochoid/results/stability.h>

#include <gtest/gtest.h>

#include <complex>
#include <string>

namespace trochoid::results::vibration_test {

using dynamics::Bounded;
using dynamics::Growing;
using dynamics::Periodic;
using dynamics::Verdict;
using test::column_of;
using test::columns_of;
using test::json_at;
using test::table_of;
using Names = std::vector<std::string>;

StabilityResult stability_result() {
  StabilityResult r;
  r.problem.setup.cut = {.a_p = 0.5e-3, .Omega = 5000 * unit::rpm};
  r.problem.system.modes = {{1.0, 2.0, 4.0, 1.0, 0.0}};
  r.stability.multiplier = {.value = std::polar(1.1, 0.5), .error = 1e-8};
  r.stability.verdict = dynamics::StabilityVerdict::unstable;
  r.stability.lines = {{900.0, 1.0}, {1100.0, 0.2}};
  r.stability.period = unit::turn / 2;
  r.stability.greatest_depth = 2e-3;
  r.stability.limit = {.limit = {.depth = 0.3e-3, .multiplier = {-1.0, 0.0}},
                       .lines = {{850.0, 1.0}}};
  r.stability.lobes = {{5000 * unit::rpm, 6000 * unit::rpm},
                       {1e-3, 2e-3},
                       {{0.5, 0.0}, {0.0, 1.5}, {0.25, 0.0}, {2.0, 0.0}}};
  r.stability.limit_curve = {
      {{.Omega = 5000 * unit::rpm, .depth = 0.3e-3, .multiplier = {-1.0, 0.0}}, 850.0}};
  return r;
}

TEST(StabilitySentence, SaysHowDeepAndAtWhichSpeedDeeper) {
  StabilityResult r = stability_result();
  EXPECT_EQ(
      stability_sentence(r),
      "Unstable: the cut at 0.5 mm and 5000 rpm chatters; at this speed it is stable "
      "to 0.3 mm. This is as sure as the modes and coefficients of the case.");
  const auto add = [&](double rpm, double depth) {
    r.stability.limit_curve.push_back(
        {{.Omega = rpm * unit::rpm, .depth = depth, .multiplier = {-1.0, 0.0}}, 850.0});
  };
  add(5500, 1.2e-3);
  add(5390, 1.2e-3);
  add(5700, 0.4e-3);
  EXPECT_NE(stability_sentence(r).find(
                "to 0.3 mm. 5390 rpm, 7.8 % faster, allows 0.951 mm, also with the "
                "spindle 2 % off. This"),
            std::string::npos)
      << stability_sentence(r);
  r.problem.setup.cut.a_p = 1e-3;
  EXPECT_NE(stability_sentence(r).find("2 % off; less than the cut asks for."),
            std::string::npos);
  r.stability.limit_curve[1].limit.depth = 0.3e-3;
  r.stability.limit_curve[2].limit.depth = 0.3e-3;
  EXPECT_NE(stability_sentence(r).find("No speed from 5102 to 5588 rpm allows"),
            std::string::npos)
      << stability_sentence(r);
  r.stability.whole = false;
  EXPECT_EQ(stability_sentence(r).find("rpm allows"), std::string::npos);
}

TEST(StabilitySentence, SaysWhenASpindleThatDriftsMakesAStableCutChatter) {
  StabilityResult r = stability_result();
  r.stability.verdict = dynamics::StabilityVerdict::stable;
  r.stability.limit->limit.depth = 1.2e-3;
  const auto point = [](double rpm, double depth) {
    return dynamics::LimitPoint{{.Omega = rpm * unit::rpm, .depth = depth}, 850.0};
  };
  r.stability.limit_curve = {point(4900, 1.2e-3), point(5000, 1.2e-3),
                             point(5050, 0.4e-3), point(5200, 0.3e-3)};
  EXPECT_NE(stability_sentence(r).find(
                "With the spindle 2 % off it may chatter from 0.37 mm on."),
            std::string::npos)
      << stability_sentence(r);
  r.problem.setup.cut.a_p = 0.3e-3;
  EXPECT_EQ(stability_sentence(r).find("2 % off it"), std::string::npos);
}

TEST(StabilitySentence, SaysHowFarBelowTheLimitAStableCutIs) {
  StabilityResult r = stability_result();
  r.stability.verdict = dynamics::StabilityVerdict::stable;
  const auto first = [&] {
    const std::string said = stability_sentence(r);
    return said.substr(0, said.find(". ") + 1);
  };
  EXPECT_EQ(first(),
            "Stable at 0.5 mm, on an island: at 5000 rpm chatter begins at 0.3 mm.");
  r.stability.limit->limit.depth = 0.52e-3;
  EXPECT_EQ(
      first(),
      "Stable to 0.52 mm at 5000 rpm: the cut of 0.5 mm lies 3.8 % below, which is "
      "close.");
  r.stability.limit.reset();
  EXPECT_EQ(first(), "Stable: at 5000 rpm no axial depth up to 2 mm chatters.");
  r.stability.verdict = dynamics::StabilityVerdict::marginal;
  EXPECT_EQ(
      first(),
      "Marginal: it is uncertain whether the cut at 0.5 mm and 5000 rpm is stable.");
}

TEST(StabilityAnswer, TablesCarryNamesAndUnits) {
  const Answer answer = answer_of(stability_result());
  const base::Table& lobes = table_of(answer, "lobes.csv");
  EXPECT_EQ(columns_of(lobes), (Names{"spindle_rpm", "axial_depth_mm", "multiplier"}));
  EXPECT_EQ(column_of(lobes, "spindle_rpm"),
            (std::vector<double>{5000, 5000, 6000, 6000}));
  EXPECT_EQ(column_of(lobes, "axial_depth_mm"), (std::vector<double>{1, 2, 1, 2}));
  EXPECT_EQ(column_of(lobes, "multiplier"), (std::vector<double>{0.5, 1.5, 0.25, 2}));
  const base::Table& limit = table_of(answer, "limit.csv");
  EXPECT_EQ(columns_of(limit), (Names{"spindle_rpm", "limit_depth_mm", "argument_deg",
                                      "chatter_frequency_Hz"}));
  EXPECT_EQ(column_of(limit, "argument_deg"), std::vector<double>{180});
}

TEST(StabilityAnswer, SaysTheVerdictAndWhatBelongsToIt) {
  const Answer answer = answer_of(stability_result());
  EXPECT_EQ(json_at(answer, "verdict"), "\"unstable\"");
  EXPECT_EQ(json_at(answer, "stable"), "false");
  EXPECT_EQ(json_at(answer, "multiplier", "type"), "\"hopf\"");
  EXPECT_EQ(json_at(answer, "multiplier", "period"), "\"tooth\"");
  EXPECT_EQ(json_at(answer, "multiplier", "chatter_frequencies_Hz"), "[900, 1100]");
  EXPECT_EQ(json_at(answer, "limit", "type"), "\"period_doubling\"");
  EXPECT_EQ(json_at(answer, "chip_floor"), "") << "of a power law only";
  EXPECT_EQ(answer.short_table,
            "unstable: a small vibration grows to 1.100000 of itself in each tooth "
            "(hopf)\n"
            "frequencies [Hz], strongest first: 900.00 1100.00\n"
            "at 5000 rpm unstable from 0.3 mm axial depth on; here 0.5 mm\n");
}

TEST(StabilityAnswer, NamesABetterSpeedNearBy) {
  StabilityResult r = stability_result();
  EXPECT_EQ(json_at(answer_of(r), "better_speed"), "null") << "none is known";
  const auto point = [](double rpm, double depth) {
    return dynamics::LimitPoint{{.Omega = rpm * unit::rpm, .depth = depth}, 850.0};
  };
  // The peak at 5600 is too sharp for a spindle; 9000 is far off.
  r.stability.limit_curve = {point(5000, 0.3e-3), point(5500, 0.7e-3),
                             point(5560, 0.6e-3), point(5600, 1.5e-3),
                             point(5640, 0.4e-3), point(9000, 5e-3)};
  const Answer answer = answer_of(r);
  EXPECT_EQ(json_at(answer, "better_speed", "spindle_rpm"), "5500");
  EXPECT_EQ(json_at(answer, "better_speed", "limit_depth_mm"), "0.6");
  EXPECT_NE(answer.short_table.find("near it, 5500 rpm allows 0.6 mm"),
            std::string::npos);
  // Between its points the limit is straight: 0.5 mm at 5390, 2 % below 5500.
  r.stability.limit_curve[0] = point(5280, 0.3e-3);
  EXPECT_NEAR(std::stod(json_at(answer_of(r), "better_speed", "limit_depth_mm")), 0.5,
              1e-9);
  r.stability.limit_curve[0] = point(5000, 0.3e-3);
  // A speed of the diagram at which every depth is stable is as good as its deepest.
  r.stability.lobes.Omega = {5870 * unit::rpm, 6000 * unit::rpm, 6130 * unit::rpm};
  r.stability.lobes.multiplier.assign(6, {0.5, 0.0});
  EXPECT_EQ(json_at(answer_of(r), "better_speed", "limit_depth_mm"), "2");
}

TEST(StabilityAnswer, AMeasuredResponseStandsBesideTheMultiplier) {
  StabilityResult r = stability_result();
  MeasuredStability& m = r.measured.emplace();
  m.band = {100 * unit::Hz, 4000 * unit::Hz};
  m.harmonics = 4;
  m.modes_fitted = true;
  m.zeroth_order = {dynamics::FrequencyLimit{5000 * unit::rpm, 0.24e-3, 940.0},
                    {{5000 * unit::rpm, 0.24e-3, 940.0}}};
  m.multi_frequency.curve = {};
  const Answer answer = answer_of(r);
  EXPECT_EQ(json_at(answer, "measured_frf", "modes_fitted"), "true");
  const base::Table& zeroth = table_of(answer, "zeroth_order.csv");
  EXPECT_EQ(columns_of(zeroth),
            (Names{"spindle_rpm", "limit_depth_mm", "chatter_frequency_Hz"}));
  EXPECT_EQ(column_of(zeroth, "limit_depth_mm"), std::vector<double>{0.24});
  EXPECT_NE(answer.short_table.find("0.24 mm (940.0 Hz) with the mean force"),
            std::string::npos);
  EXPECT_NE(answer.short_table.find("none with 4 harmonics"), std::string::npos);
  EXPECT_EQ(answer.texts.front().file, "modes.toml");
  EXPECT_EQ(json_at(answer, "verdict"), "\"unstable\"") << "that of the multiplier";
  // Without modes nothing of the multiplier is said.
  r.no_modes = "no resonance";
  const Answer alone = answer_of(r);
  EXPECT_EQ(json_at(alone, "multiplier"), "null");
  EXPECT_EQ(json_at(alone, "verdict"), "\"stable\"") << "no limit was found";
  EXPECT_EQ(alone.tables.size(), 2U);
}

TEST(StabilityAnswer, ALimitThatIsNotKnownIsNull) {
  StabilityResult r = stability_result();
  r.stability.limit.reset();
  const Answer answer = answer_of(r);
  EXPECT_EQ(json_at(answer, "limit_depth_mm"), "null");
  EXPECT_EQ(json_at(answer, "limit"), "");
  EXPECT_NE(answer.short_table.find("no axial depth up to 2 mm is unstable"),
            std::string::npos);
}

TEST(StabilityAnswer, SaysWhatDamps) {
  StabilityResult r = stability_result();
  EXPECT_EQ(json_at(answer_of(r), "process_damping"), "");
  r.problem.setup.process_damping = {80 * unit::um, 30000 * unit::N_per_mm3, 0.25};
  r.stability.sharp_limit = dynamics::Limit{.depth = 0.2e-3};
  const Answer answer = answer_of(r);
  EXPECT_EQ(json_at(answer, "process_damping", "wear_land_um"), "80");
  EXPECT_EQ(json_at(answer, "process_damping", "indentation_N_per_mm3"), "30000");
  EXPECT_EQ(json_at(answer, "process_damping", "flank_friction"), "0.25");
  EXPECT_EQ(json_at(answer, "process_damping", "limit_depth_without_mm"), "0.2");
  EXPECT_NE(answer.short_table.find("with process damping of a wear land of 80 um; "
                                    "without it unstable from 0.2 mm on\n"),
            std::string::npos);
  r.stability.sharp_limit.reset();
  EXPECT_EQ(json_at(answer_of(r), "process_damping", "limit_depth_without_mm"), "null");
}

/// Two teeth, two samples, a tool and a table mode.
MotionResult motion_result(const Verdict& verdict) {
  MotionResult r;
  r.system.modes = {{.x = 1.0, .y = 0.0}, {.x = -1.0, .y = 0.0, .of_table = true}};
  r.steps_per_tooth = 1000;
  r.engagement = {0.0, unit::turn / 2};
  r.entry = {0.0, unit::turn / 2};
  r.steady = {.motion = {.time = {0.0, 0.01},
                         .angle = {0.0, unit::deg},
                         .force = {{1, 2, 3}, {4, 5, 6}},
                         .mode = {{1e-6, 2e-6}, {5e-6, 6e-6}},
                         .actuator = {7e-6, 8e-6},
                         .command = {9e-6, 10e-6},
                         .once = {{1e-6, -2e-6}, {1e-6, -3e-6}},
                         .flutes = {{40, 20, 1e-3, 1e-5}, {30, 10, 2e-3, 2e-5}},
                         .last_change = 0.5,
                         .peak = 44,
                         .turns_done = 20},
              .verdict = verdict};
  r.walls = {{.sigma = -1, .height = 0.0, .teeth = {3e-6, -4e-6}, .remains = -4e-6},
             {.sigma = -1, .height = 1e-3, .teeth = {3e-6, -4e-6}, .remains = -4e-6}};
  return r;
}

TEST(MotionAnswer, SaysWhatDamps) {
  MotionResult r = motion_result(Periodic{2, 2});
  EXPECT_EQ(json_at(answer_of(r), "process_damping"), "");
  r.damping = {80 * unit::um, 30000 * unit::N_per_mm3, 0.25};
  const Answer answer = answer_of(r);
  EXPECT_EQ(json_at(answer, "process_damping", "wear_land_um"), "80");
  EXPECT_NE(answer.short_table.find("with process damping of a wear land of 80 um\n"),
            std::string::npos);
}

TEST(MotionAnswer, OfASteadyStateHasItsTables) {
  const Answer answer = answer_of(motion_result(Periodic{2, 2}));
  const base::Table& motion = table_of(answer, "motion.csv");
  EXPECT_EQ(columns_of(motion),
            (Names{"angle_deg", "time_s", "x_tool_um", "y_tool_um", "x_table_um",
                   "y_table_um", "x_actuator_um", "command_um"}));
  EXPECT_DOUBLE_EQ(column_of(motion, "x_tool_um")[1], 2.0);
  EXPECT_DOUBLE_EQ(column_of(motion, "x_table_um")[0], 5.0);
  EXPECT_EQ(column_of(motion, "y_table_um")[0], 0.0);
  EXPECT_EQ(columns_of(table_of(answer, "forces.csv")),
            (Names{"angle_deg", "time_s", "Fx_N", "Fy_N", "Fz_N"}));
  const base::Table& once = table_of(answer, "once_per_turn.csv");
  EXPECT_EQ(columns_of(once), (Names{"turn", "x_um", "y_um"}));
  EXPECT_EQ(column_of(once, "turn"), (std::vector<double>{0, 1}));
  const base::Table& walls = table_of(answer, "surface_location.csv");
  EXPECT_EQ(columns_of(walls), (Names{"sigma", "height_mm", "tooth", "error_um"}));
  EXPECT_EQ(column_of(walls, "height_mm"), (std::vector<double>{0, 0, 1, 1}));
  EXPECT_EQ(column_of(walls, "tooth"), (std::vector<double>{1, 2, 1, 2}));
}

TEST(MotionAnswer, OfASteadyStateSaysThatItRepeats) {
  const Answer answer = answer_of(motion_result(Periodic{2, 2}));
  EXPECT_EQ(json_at(answer, "verdict"), "\"periodic\"");
  EXPECT_EQ(json_at(answer, "difference"), "0.5");
  EXPECT_EQ(json_at(answer, "growth_per_turn"), "null") << "none was seen";
  EXPECT_EQ(json_at(answer, "linear_growth_per_turn"), "null");
  EXPECT_EQ(json_at(answer, "engagement_deg"), "[0, 180]");
  EXPECT_NE(answer.short_table.find(
                "0.5 N in the last of 20 turns: it repeats with every turn\n"),
            std::string::npos)
      << answer.short_table;
  EXPECT_NE(answer.short_table.find("up-milled wall -4.000 um off at the tip"),
            std::string::npos);
  EXPECT_NE(answer_of(motion_result(Bounded{.fades = true}))
                .short_table.find("it does not repeat yet"),
            std::string::npos);
}

TEST(MotionAnswer, OfAPeriodSaysHowLongItIs) {
  const Answer answer =
      answer_of(motion_result(Periodic{.passes = 4, .passes_of_cut = 1}));
  EXPECT_EQ(json_at(answer, "period", "teeth"), "4");
  EXPECT_EQ(json_at(answer, "period", "turns"), "2");
  EXPECT_EQ(json_at(answer, "period", "teeth_of_cut"), "1");
  EXPECT_EQ(json_at(answer, "chatter"), "true");
  EXPECT_NE(answer.short_table.find("it repeats every 2 turns\n"), std::string::npos);
}

TEST(MotionAnswer, OfBoundedChatterHasItsAmplitudes) {
  const Bounded bounded{.amplitude = {20e-6, 5e-6},
                        .turns = 32,
                        .lines = {{83.0, {3e-6, 0}, 1}, {931.5, {15e-6, 1e-6}, 0}},
                        .spectrum_step = 2.5,
                        .spectrum = {{0, 0}, {1e-6, 2e-6}}};
  const Answer answer = answer_of(motion_result(bounded));
  EXPECT_EQ(json_at(answer, "verdict"), "\"bounded\"");
  EXPECT_EQ(json_at(answer, "chatter"), "true");
  EXPECT_EQ(json_at(answer, "settles"), "false");
  EXPECT_EQ(json_at(answer, "period"), "null");
  EXPECT_EQ(json_at(answer, "vibration", "turns"), "32");
  EXPECT_EQ(json_at(answer, "vibration", "chatter_frequency_Hz"), "931.5");
  EXPECT_NE(answer.short_table.find("chatter within 20 um along x and 5 um along y"),
            std::string::npos)
      << answer.short_table;
  EXPECT_NE(answer.short_table.find("chatter frequency 931.5 Hz"), std::string::npos);
  const base::Table& spectrum = table_of(answer, "spectrum.csv");
  EXPECT_EQ(columns_of(spectrum), (Names{"frequency_Hz", "x_um", "y_um"}));
  EXPECT_EQ(column_of(spectrum, "frequency_Hz"), (std::vector<double>{0, 2.5}));
  EXPECT_DOUBLE_EQ(column_of(spectrum, "y_um")[1], 2.0);
}

TEST(MotionAnswer, OfAMotionThatGrowsGivesNoAmplitudes) {
  const Answer answer = answer_of(motion_result(Growing{1.15}));
  EXPECT_EQ(json_at(answer, "verdict"), "\"growing\"");
  EXPECT_EQ(json_at(answer, "change_N"), "null");
  EXPECT_EQ(json_at(answer, "growth_per_turn"), "1.15");
  EXPECT_EQ(json_at(answer, "flutes"), "");
  ASSERT_EQ(answer.tables.size(), 1U);
  EXPECT_EQ(answer.tables[0].file, "once_per_turn.csv");
  EXPECT_EQ(answer.short_table, "");
}

TEST(MotionAnswer, WithoutAMotionIsEmpty) {
  MotionResult r = motion_result(Periodic{2, 2});
  r.steady.reset();
  r.heading = {.ok = false, .message = "why"};
  const Answer answer = answer_of(r);
  EXPECT_EQ(json_text(answer.result), "null");
  EXPECT_TRUE(answer.tables.empty());
  EXPECT_FALSE(answer.heading.ok);
}

}  // namespace trochoid::results::vibration_test
