#include "correct_case.h"

#include <trochoid/run/commands.h>

#include <algorithm>

namespace trochoid::run::correct_test {

using test::Changes;
using test::correction_case;

results::CorrectResult corrected(const Changes& changes, bool controller = false) {
  return correct(correction_case(changes), controller, {});
}

double left(const results::CorrectResult& r) {
  return dynamics::peak_difference(r.correction.cuts.after.motion);
}

bool warned(const results::CorrectResult& r, const std::string& code) {
  const auto all = test::codes(r.heading.warnings);
  return std::find(all.begin(), all.end(), code) != all.end();
}

/// [diez2010]: 38 % before, 30 um for an estimated 26 um, near equal after, the table
/// within 10 %; at least 86 % less is what a correction of it has to reach.
TEST(Correct, ReproducesTheCaseOfThePaper) {
  const auto r = corrected({});
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  EXPECT_EQ(r.heading.message.find("The flutes' peaks differ by 0.0"), 0U)
      << r.heading.message;
  EXPECT_NE(r.heading.message.find(" Nearest to its limit: the command takes 30."),
            std::string::npos)
      << r.heading.message;
  EXPECT_EQ(r.heading.title, "Runout corrected by the table: 8 mm, 2 flutes");
  EXPECT_FALSE(r.heading.case_toml.empty());
  const correction::Correction& c = r.correction;
  EXPECT_NEAR(dynamics::peak_difference(c.cuts.before.motion), 0.388, 0.002);
  EXPECT_LT(left(r), 0.002);
  EXPECT_GT(correction::reduction(c.cuts).value_or(0), 0.86);
  EXPECT_NEAR(correction::chip_differences(c.setting.rho)[0], 27.8e-6, 1e-12);
  EXPECT_NEAR(c.setting.fit->h_ro[0].value, 26.0e-6, 0.5e-6);
  EXPECT_NEAR(correction::range_of(c.plan.command.wave).peak_to_peak(), 30.2e-6,
              0.3e-6);
  EXPECT_LT(c.cuts.table_deviation, 0.1 * 30.3e-6);
  EXPECT_TRUE(c.plan.limits.ok);
  // Equal peaks are not equal chips, and the answer says so.
  EXPECT_GT(dynamics::area_difference(c.cuts.after.motion), 0.3);
  EXPECT_TRUE(warned(r, "unequal_chips"));
}

TEST(Correct, FindsRunoutBehindWhatGivesWay) {
  const auto r = correct(test::measured_case(), false, {});
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  const correction::Setting& s = r.correction.setting;
  EXPECT_NEAR(correction::chip_differences(s.rho)[0], 27.8e-6, 0.4e-6);
  EXPECT_LT(s.fit->h_ro[0].value, 26.5e-6);
}

TEST(Correct, CommandForARigidReadingLeavesWhatGivesWay) {
  const auto r = corrected({{"[correct]", "[correct]\nestimate = \"static_fit\""}});
  EXPECT_GT(left(r), 0.02);
  EXPECT_GT(correction::reduction(r.correction.cuts).value_or(0), 0.86);
  EXPECT_TRUE(warned(r, "static_estimate"));
}

TEST(Correct, ShapesAndStrategiesMakePeaksEqual) {
  using Pair = std::pair<std::string, std::string>;
  for (const auto& [shape, strategy] :
       {Pair{"sine", "plain"}, Pair{"square", "lead"}, Pair{"trapezoid", "inverse"},
        Pair{"quintic", "inverse_in_time"}, Pair{"harmonics", "learning"}}) {
    SCOPED_TRACE(shape + " " + strategy);
    const auto r =
        corrected({{"shape = \"sine\"", "shape = \"" + shape + "\""},
                   {"strategy = \"lead\"",
                    "strategy = \"" + strategy + "\"\nspindle_rpm = [1000, 2000, 2]"}});
    ASSERT_TRUE(r.heading.ok) << r.heading.message;
    EXPECT_LT(left(r), 0.005);
  }
}

TEST(Correct, SaysWhatIsBeyondALimit) {
  const auto r = corrected({{"stroke_um = [0, 60]", "stroke_um = [0, 20]"},
                            {"push_N = 2000", "push_N = 10"}});
  ASSERT_TRUE(r.heading.ok);
  EXPECT_FALSE(r.correction.plan.limits.ok);
  EXPECT_LT(r.correction.plan.limits.limits.at(0).margin, 0);
  EXPECT_TRUE(warned(r, "beyond_limit"));
}

/// A tool that chatters has no peaks to make equal.
TEST(Correct, RefusesACutThatChatters) {
  const std::string soft = "stiffness_N_per_m = 8e6";
  const auto r = corrected({{soft, "stiffness_N_per_m = 5e5"},
                            {soft, "stiffness_N_per_m = 5e5"},
                            {"axial_depth_mm = 1", "axial_depth_mm = 3"}});
  EXPECT_FALSE(r.heading.ok);
  EXPECT_NE(r.heading.message.find("chatter"), std::string::npos) << r.heading.message;
}

/// Four teeth in a slot: two cut at once, one axis cannot serve both.
TEST(Correct, SaysWhatOneAxisCannotDo) {
  const auto r = corrected({{"teeth = 2", "teeth = 4"},
                            {"[0.0139, -0.0139]", "[0.010, -0.004, 0.003, -0.009]"},
                            {"strategy = \"lead\"", "strategy = \"inverse\""},
                            {"target = \"peak_force\"", "target = \"least_squares\""},
                            {"axial_depth_mm = 1", "axial_depth_mm = 0.2"},
                            {"adapt = true", "adapt = false"}});
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  EXPECT_EQ(r.correction.axes.most_teeth, 2);
  EXPECT_TRUE(warned(r, "several_teeth_in_cut"));
}

TEST(CorrectController, LearnsTheAmplitudeInFiveTurns) {
  const auto r = corrected({}, true);
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  const correction::ControllerInLoop& c = *r.correction.controller;
  EXPECT_GT(c.turns[correction::enabling_turn - 1].difference, 0.38);
  EXPECT_LT(last_running(c)->difference, 0.01);
  EXPECT_LE(turns_to_equal(c, 0.03).value_or(100), 5);
  EXPECT_GE(c.lowest, 0.0);
  EXPECT_LE(c.highest, 60e-6);
  EXPECT_EQ(c.fault, TROCHOID_NO_PROBLEM);
}

TEST(CorrectController, GoesToMidStrokeWithoutIndexPulses) {
  const auto r =
      corrected({{"adapt = true",
                  "index_lost_at_turn = 25\njitter_s = 1e-4\nspeed_ripple = 0.02"}},
                true);
  const correction::ControllerInLoop& c = *r.correction.controller;
  EXPECT_EQ(c.fault, TROCHOID_INDEX_LOST);
  EXPECT_LT(last_running(c)->difference, 0.03);
  ASSERT_TRUE(c.time_to_safe);
  EXPECT_LT(*c.time_to_safe, 0.2);
  EXPECT_NEAR(c.samples.back().command, 30e-6, 1e-12);
  EXPECT_GT(c.turns.back().difference, 0.3) << "no correction, no equal peaks";
}

}  // namespace trochoid::run::correct_test
