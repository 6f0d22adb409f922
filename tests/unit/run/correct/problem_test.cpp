#include "correct_case.h"

#include <trochoid/base/units.h>
#include <trochoid/run/correct.h>

namespace trochoid::run::problem_test {

using test::correction_case;

correction::CorrectionProblem problem_of(const cases::Case& given,
                                         bool controller = false) {
  std::vector<base::Warning> warnings;
  return correction_problem(given, controller, warnings);
}

TEST(CorrectionProblem, IsTheCase) {
  const auto p = problem_of(correction_case(
      {{"[correct]",
        "[sampling]\nrevolutions = 7\nsamples_per_rev = 360\n[correct]\n"
        "spindle_rpm = [1000, 3000, 3]\nharmonics = 5"},
       {"stroke_um = [0, 60]", "stroke_um = [10, 50]"}}));
  ASSERT_EQ(p.cut.tool.size(), 2U) << "the table is no mode of the tool";
  EXPECT_EQ(p.cut.tool[1].y, 1.0);
  EXPECT_EQ(p.cut.plant.table.mass, 0.194);
  EXPECT_EQ(p.cut.revolutions, 7);
  EXPECT_EQ(p.cut.samples_per_rev, 360);
  EXPECT_EQ(p.cut.slices, 1) << "no helix";
  EXPECT_NEAR(p.limits.stroke_low, 10e-6, 1e-15);
  EXPECT_NEAR(p.limits.stroke_high, 50e-6, 1e-15);
  EXPECT_EQ(p.options.strategy, correction::Method::lead);
  EXPECT_EQ(p.options.harmonics, 5);
  ASSERT_EQ(p.options.spindle_speeds.size(), 3U);
  EXPECT_NEAR(p.options.spindle_speeds[1], 2000 * unit::rpm, 1e-9);
  EXPECT_FALSE(p.record);
}

TEST(CorrectionProblem, FollowsAHelixInSlices) {
  EXPECT_GT(
      problem_of(correction_case({{"helix_deg = 0 ", "helix_deg = 30 "}})).cut.slices,
      10);
}

TEST(CorrectionProblem, TakesNoMoreSlicesThanAHelixLags) {
  const auto slices = [](const char* helix) {
    return problem_of(correction_case({{"helix_deg = 0 ", helix}})).cut.slices;
  };
  EXPECT_EQ(slices("helix_deg = 1e-300 "), 1);
  const int few = slices("helix_deg = 1 ");
  EXPECT_GE(few, 1);
  EXPECT_LT(few, slices("helix_deg = 30 "));
}

TEST(CorrectionProblem, HasAControllerWhereOneIsAskedFor) {
  const cases::Case given =
      correction_case({{"encoder_counts = 4096", "encoder_counts = 100"}});
  EXPECT_FALSE(problem_of(given).controller);
  const auto with = problem_of(given, true).controller;
  ASSERT_TRUE(with);
  EXPECT_EQ(with->counts, 100);
  EXPECT_TRUE(with->adapt);
  const auto usual = problem_of(correction_case({{"[controller]", "# [controller]"},
                                                 {"loop_rate_Hz", "# loop_rate_Hz"},
                                                 {"encoder_counts", "# encoder_counts"},
                                                 {"adapt", "# adapt"}}),
                                true)
                         .controller;
  ASSERT_TRUE(usual);
  EXPECT_EQ(usual->counts, correction::LoopOptions{}.counts);
}

TEST(CorrectionProblem, HasTheForcesOfAMeasurement) {
  const auto p = problem_of(test::measured_case());
  ASSERT_TRUE(p.record);
  EXPECT_GT(p.record->angle.size(), 100U);
  EXPECT_EQ(p.record->force.size(), p.record->angle.size());
  EXPECT_NEAR(p.cut.setup.cut.Omega, 1200 * unit::rpm, 1e-9);
}

}  // namespace trochoid::run::problem_test
