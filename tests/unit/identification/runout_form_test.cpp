#include <trochoid/identification/runout_form.h>

#include "made_record.h"

#include <gtest/gtest.h>

/// The form of the runout that a record decides for.
namespace trochoid::identification::runout_form_test {

force::Setup four_flutes() {
  force::Setup setup = slot_setup(4, 40.0, 8.0 * unit::mm);
  setup.cut.engagement = geometry::UpMilling{3.0 * unit::mm};
  return setup;
}

std::vector<Record> records(force::Setup setup, double noise) {
  std::vector<Record> out;
  for (const double f_z : {30e-6, 60e-6}) {
    setup.cut.f_z = f_z;
    out.push_back(made_record(
        setup, steel(), {.per_turn = 120, .turns = 6, .noise = noise, .seed = 5}));
  }
  return out;
}

Fit offsets_fit(const std::vector<Record>& runs) {
  Options options;
  options.phase = 0.0;
  return identify(four_flutes(), steel(), runs, options);
}

FormChoice chosen(const force::Setup& truth, double noise) {
  const std::vector<Record> runs = records(truth, noise);
  return choose_runout(four_flutes(), steel(), runs, offsets_fit(runs));
}

TEST(RunoutForm, IsAnEccentricityWhereTheEdgesTellIt) {  // [I-18]
  force::Setup truth = four_flutes();
  truth.runout.eccentricity = 12.0 * unit::um;
  truth.runout.angle = 50.0 * unit::deg;
  const FormChoice choice = chosen(truth, 5.0);
  ASSERT_EQ(choice.fit.options.runout, RunoutUnknowns::eccentricity) << choice.why;
  ASSERT_TRUE(choice.fit.eccentricity_se);
  EXPECT_NEAR(choice.fit.runout.eccentricity, 12.0 * unit::um,
              choice.fit.interval_factor * *choice.fit.eccentricity_se);
  EXPECT_NE(choice.why.find("an eccentricity leaves"), std::string::npos) << choice.why;
}

TEST(RunoutForm, IsOffsetsWhereTheseLeaveNoise) {  // [I-18]
  force::Setup truth = four_flutes();
  truth.runout.radial_offsets = {0.0, 8.0 * unit::um, -5.0 * unit::um, 3.0 * unit::um};
  const FormChoice choice = chosen(truth, 5.0);
  EXPECT_EQ(choice.fit.options.runout, RunoutUnknowns::offsets) << choice.why;
}

TEST(RunoutForm, IsBothWhereNeitherAloneSuffices) {  // [I-18]
  force::Setup truth = four_flutes();
  truth.runout.radial_offsets = {0.0, 14.0 * unit::um, -4.0 * unit::um, 9.0 * unit::um};
  truth.runout.eccentricity = 15.0 * unit::um;
  truth.runout.angle = 100.0 * unit::deg;
  const FormChoice choice = chosen(truth, 2.0);
  ASSERT_EQ(choice.fit.options.runout, RunoutUnknowns::both) << choice.why;
  EXPECT_NEAR(choice.fit.coefficients[0]->value / steel().K_tc, 1.0, 0.01);
  EXPECT_NEAR(choice.fit.runout.eccentricity, 15.0 * unit::um,
              choice.fit.interval_factor * *choice.fit.eccentricity_se);
}

TEST(RunoutForm, IsNoneWhereOffsetsAreSmallAndMayBeZero) {
  const FormChoice choice = chosen(four_flutes(), 5.0);
  EXPECT_EQ(choice.fit.options.runout, RunoutUnknowns::none);
  EXPECT_EQ(choice.why.find("none is seen: the teeth differ by less than"), 0U)
      << choice.why;
}

TEST(RunoutForm, OfAStatedFitIsComparedWithTheOthers) {  // [I-18]
  force::Setup truth = four_flutes();
  truth.runout.eccentricity = 12.0 * unit::um;
  truth.runout.angle = 50.0 * unit::deg;
  const std::vector<Record> runs = records(truth, 5.0);
  const FormChoice choice =
      better_runout(four_flutes(), steel(), runs, offsets_fit(runs));
  EXPECT_EQ(choice.fit.options.runout, RunoutUnknowns::eccentricity);
  ASSERT_GE(choice.tried.size(), 2U);
  EXPECT_EQ(choice.tried.front().form, RunoutUnknowns::offsets);
  EXPECT_GT(choice.tried.front().excess, 4.0);
}

}  // namespace trochoid::identification::runout_form_test
