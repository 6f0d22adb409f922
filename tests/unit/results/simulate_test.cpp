#include <trochoid/results/simulate.h>

#include <trochoid/base/units.h>
#include <trochoid/results/json.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace trochoid::results::simulate_test {

/// Two samples of a cut with two teeth, the second of which idles.
SimulateResult made() {
  SimulateResult r;
  r.heading.title = "made";
  r.phi = {0.0, 90 * unit::deg};
  r.Omega = 100.0;
  r.loads = {{.force = {1, 2, 3}, .torque = 4, .bending = 5},
             {.force = {-1, 0, 3}, .torque = 2, .bending = 1}};
  r.force = force::force_statistics(r.loads);
  r.moments = force::moment_statistics(r.loads);
  r.engagement.height = 1 * unit::mm;
  r.engagement.teeth = {
      {.arcs = {{10 * unit::deg, 50 * unit::deg}}, .peak_chip = 40 * unit::um}, {}};
  r.engagement.removal = {.removed = 2e-6, .available = 2e-6};
  r.chips = {.theta = {0.0, 1.0},
             .height = {0.5 * unit::mm},
             .h = {1 * unit::um, 2 * unit::um, 3 * unit::um, 4 * unit::um},
             .mark = {1, 2, 2, 1}};
  return r;
}

const base::Table& table(const Answer& answer, const std::string& file) {
  return *std::find_if(answer.tables.begin(), answer.tables.end(),
                       [&](const base::Table& t) { return t.file == file; });
}

std::vector<double> column(const base::Table& table, const std::string& name) {
  for (const auto& c : table.columns) {
    if (c.name == name) {
      return c.values;
    }
  }
  ADD_FAILURE() << "no column " << name;
  return {};
}

std::string value(const Answer& answer, std::string_view key) {
  const Value* found = find(answer.result, key);
  return found != nullptr ? json_text(*found) : "absent";
}

TEST(SimulateSentence, SaysTheForceAndThatNothingIsBesideIt) {
  EXPECT_EQ(
      simulation_sentence(made()),
      "The force in the plane of the table is 2.24 N at most, the mean force 0, 1, "
      "3 N in x, y, z; the torque is 3 N m on average and 4 N m at most. Tooth 2 "
      "cuts nothing 1 mm above the tip. It is not compared with a measurement: "
      "it is as good as the coefficients and the runout of the case.");
}

TEST(SimulateSentence, SaysHowMuchOfARecordIsMissed) {
  SimulateResult r = made();
  r.engagement.teeth.pop_back();
  r.comparison = {{.file = "record.csv", .match = {.rms = 30, .measured_rms = 100}}};
  r.heading.warnings = {{"volume", "..."}};
  const std::string said = simulation_sentence(r);
  EXPECT_TRUE(said.ends_with(
      " Take it with care: the chips do not add up to the material there is. From "
      "the force measured in record.csv it differs by 30 % of that (rms, noise and "
      "offsets of the record included)."))
      << said;
  EXPECT_EQ(said.find("cuts nothing"), std::string::npos) << said;
  r.heading.warnings = {{"no_cut", "..."}};
  EXPECT_EQ(simulation_sentence(r), "No tooth cuts anything: see the warnings.");
}

TEST(SimulateAnswer, HasItsNumbersInTheUnitsOfFiles) {
  const Answer answer = answer_of(made());
  EXPECT_EQ(answer.command, "simulate");
  EXPECT_EQ(answer.heading.title, "made");
  EXPECT_EQ(value(answer, "mean_N"), "[0, 1, 3]");
  EXPECT_EQ(value(answer, "torque_mean_Nm"), "3");
  EXPECT_EQ(value(answer, "power_W"), "300");
  EXPECT_EQ(value(answer, "teeth_height_mm"), "1");
  EXPECT_EQ(value(answer, "bending_peak_Nm"), "absent") << "no gauge length";
  EXPECT_EQ(value(answer, "closed_form_mean_N"), "absent");
  EXPECT_EQ(value(answer, "comparison"), "absent");
  const base::Table& forces = table(answer, "forces.csv");
  EXPECT_EQ(column(forces, "angle_deg"), (std::vector{0.0, 90.0}));
  EXPECT_EQ(column(forces, "Fy_N"), (std::vector{2.0, 0.0}));
  EXPECT_EQ(forces.columns.size(), 5U) << "no channels without a dynamometer";
  const base::Table& chips = table(answer, "chip.csv");
  EXPECT_EQ(column(chips, "tooth"), (std::vector{1.0, 1.0, 2.0, 2.0}));
  EXPECT_EQ(column(chips, "h_mm"), (std::vector{0.001, 0.002, 0.003, 0.004}));
}

TEST(SimulateAnswer, HasWhatTheChannelsRead) {
  SimulateResult r = made();
  r.channels = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
  const Answer answer = answer_of(r);
  EXPECT_EQ(column(table(answer, "forces.csv"), "channel1_N"),
            (std::vector{-2.0, 0.0}));
}

TEST(SimulateAnswer, TellsAPersonWhichToothIdles) {
  const std::string text = answer_of(made()).short_table;
  EXPECT_NE(text.find("tooth 1: chip up to 0.04000 mm, cuts 10.000..50.000 deg\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("tooth 2: cuts nothing\n"), std::string::npos);
}

TEST(SimulateAnswer, SetsMeasurementsBesideTheForces) {
  SimulateResult r = made();
  Comparison c{.file = "record.csv", .Omega = 600 * unit::rpm};
  c.run.angle = {0.0, 1.0};
  c.run.force = {{1, 2, 3}, {4, 5, 6}};
  c.match.phase = 90 * unit::deg;
  c.match.computed = {{1, 2, 3}, {4, 5, 9}};
  c.match.rms = 2.0;
  c.match.measured_rms = 8.0;
  r.comparison = {c};
  const Answer answer = answer_of(r);
  EXPECT_NE(answer.short_table.find("difference 2.00 N (25.0 % of the force)"),
            std::string::npos)
      << answer.short_table;
  EXPECT_NE(value(answer, "comparison").find("\"phase_deg\": 90"), std::string::npos);
  EXPECT_EQ(answer.tables.size(), 5U) << "the measured and the computed curves too";
}

}  // namespace trochoid::results::simulate_test
