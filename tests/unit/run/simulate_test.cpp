#include <trochoid/run/commands.h>

#include "made_record_file.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace trochoid::run::simulate_test {

using namespace test;

results::SimulateResult simulated(const std::string& text) {
  const CaseFolder folder;
  return simulate(folder.read(text));
}

std::vector<std::string> codes(const results::SimulateResult& r) {
  std::vector<std::string> out;
  for (const base::Warning& w : r.heading.warnings) {
    out.push_back(w.code);
  }
  return out;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// Printed in a forum and found by closed integrals.
TEST(Simulate, AnswersTheMeanOfTheTurnAndNotOfItsSamples) {
  for (const char* samples : {"360", "720", "1000"}) {
    const auto r = simulated(std::string(R"([tool]
teeth = 3
diameter_mm = 20
helix_deg = 0
[cut]
engagement = "up"
radial_depth_mm = 8
axial_depth_mm = 15
feed_per_tooth_mm = 0.1
spindle_rpm = 3000
[chip]
model = "feed"
[force]
K_tc_MPa = 800
K_rc_MPa = 200
K_ac_MPa = 0
K_te_N_per_mm = 10
K_re_N_per_mm = 10
K_ae_N_per_mm = 0
[sampling]
revolutions = 10
samples_per_rev = )") + samples +
                             "\n");
    EXPECT_NEAR(r.force.mean[0], -486.5325, 1e-3) << samples;
    EXPECT_NEAR(r.force.mean[1], 254.5452, 1e-3) << samples;
  }
}

TEST(Simulate, AnswersTheForcesOfItsSamples) {
  const auto r = simulated(cases::test::slot + runout);
  ASSERT_EQ(r.phi.size(), 720U);
  const auto expected = force::forces(made_setup(), made_law(), r.phi, 1e-10);
  const auto peak = std::max_element(
      expected.begin(), expected.end(),
      [](const auto& a, const auto& b) { return std::abs(a[1]) < std::abs(b[1]); });
  for (std::size_t i = 0; i < r.phi.size(); ++i) {
    EXPECT_NEAR(r.loads[i].force[1], expected[i][1], 2e-6 * std::abs((*peak)[1]));
  }
  EXPECT_FALSE(r.closed_form_mean.has_value()) << "the mean of F-8 knows no runout";
  EXPECT_TRUE(r.comparison.empty());
  EXPECT_TRUE(codes(r).empty());
}

TEST(Simulate, GivesTheClosedFormWhereItHolds) {
  const auto r = simulated(cases::test::slot + "[chip]\nmodel = \"none\"\n");
  ASSERT_TRUE(r.closed_form_mean.has_value());
  EXPECT_NEAR((*r.closed_form_mean)[2], r.force.mean[2],
              1e-3 * std::abs(r.force.mean[2]));
}

TEST(Simulate, SaysWhichToothIdles) {
  const auto r =
      simulated(cases::test::slot + "[runout]\nradial_offsets_mm = [0.0, -0.1]\n");
  EXPECT_EQ(codes(r), std::vector<std::string>{"idle_tooth"});
  EXPECT_TRUE(r.engagement.teeth.at(1).arcs.empty());
}

TEST(Simulate, SaysThatNothingIsCutWithoutFeed) {
  const auto r = simulated(
      replaced(cases::test::slot, "feed_per_tooth_mm = 0.04", "feed_per_tooth_mm = 0"));
  EXPECT_EQ(codes(r), (std::vector<std::string>{"no_cut", "zero_feed"}));
}

TEST(Simulate, SaysWhatAHeightAboveTheCutMeans) {
  const auto r =
      simulated(cases::test::slot + "[sampling]\nedge_heights_mm = [1.0, 5.0]\n");
  EXPECT_EQ(codes(r), std::vector<std::string>{"height_above_cut"});
}

TEST(Simulate, SaysThatOneToothBackDoesNotConserveTheVolume) {
  const auto r = simulated(cases::test::slot +
                           "[runout]\nradial_offsets_mm = [0.0, -0.1]\n"
                           "[chip]\nmodel = \"feed\"\nlookback = \"previous\"\n");
  const auto seen = codes(r);
  EXPECT_NE(std::find(seen.begin(), seen.end(), "volume"), seen.end());
}

}  // namespace trochoid::run::simulate_test
