#include <trochoid/identification/next_cut.h>

#include "made_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace trochoid::identification::plan_test {

/// Three teeth in a quarter of the width, two feeds.
class Plan : public testing::Test {
 protected:
  void SetUp() override {
    setup = slot_setup(3, 30.0, 2.0 * unit::mm);
    setup.cut.engagement = geometry::UpMilling{2.0 * unit::mm};
    setup.runout.radial_offsets = {0.0, -8.0 * unit::um, 5.0 * unit::um};
    for (const double f_z : {30e-6, 60e-6}) {
      force::Setup own = setup;
      own.cut.f_z = f_z;
      runs.push_back(made_record(
          own, steel(), {.phase = 1e4 * f_z, .per_turn = 90, .noise = 8.0, .seed = 3}));
    }
  }

  [[nodiscard]] Trial trial() const {
    return {.setup = setup,
            .law = steel(),
            .options = {},
            .samples_per_turn = 90,
            .turns = 1.0,
            .noise = 8.0};
  }

  force::Setup setup;
  std::vector<Record> runs;
};

double half(const Estimate& K) {
  return 0.5 * (K.high - K.low);
}

TEST_F(Plan, StartsFromTheIntervalsOfTheRecords) {  // [I-20] [I-4]
  const Fit fit =
      identify(without_runout(setup), steel(), runs, {.errors = Errors::white});
  ASSERT_TRUE(fit.ok) << fit.message;
  const Information known =
      information_of(without_runout(setup), steel(), runs, fit, 0);
  ASSERT_EQ(known.size, 8U);
  EXPECT_EQ(parameter_names(setup, steel(), {})[7], "radial_offsets_mm[3]");
  const double t = fit.interval_factor;
  for (std::size_t c = 0; c < 6; ++c) {
    const double expected = half(*fit.coefficients[c]);
    EXPECT_NEAR(t * *standard_error(known, c), expected, 1e-6 * expected) << c;
  }
  EXPECT_NEAR(*standard_error(known, 6), *fit.radial_offsets_se[1],
              1e-6 * *fit.radial_offsets_se[1]);
}

TEST_F(Plan, KnowsTheGroupThatIsAskedFor) {  // [I-19] [I-20]
  runs[0].group = "new";
  runs[1].group = "worn";
  const Fit fit =
      identify(without_runout(setup), steel(), runs, {.errors = Errors::white});
  ASSERT_TRUE(fit.ok) << fit.message;
  const double t = fit.interval_factor;
  for (const std::size_t g : {0U, 1U}) {
    const Information known =
        information_of(without_runout(setup), steel(), runs, fit, g);
    const double expected = half(*fit.groups[g].coefficients[3]);
    EXPECT_NEAR(t * *standard_error(known, 3), expected, 1e-6 * expected) << g;
  }
}

TEST_F(Plan, TurnsAddUpAndNoiseTakesAway) {  // [I-20]
  const Information one = information_of(trial());
  Trial longer = trial();
  longer.turns = 9.0;
  const Information nine = information_of(longer);
  longer.noise *= 3.0;
  const Information noisy = information_of(longer);
  for (std::size_t i = 0; i < one.size; ++i) {
    EXPECT_NEAR(*standard_error(nine, i), *standard_error(one, i) / 3.0,
                1e-9 * *standard_error(one, i));
    EXPECT_NEAR(*standard_error(noisy, i), *standard_error(one, i),
                1e-9 * *standard_error(one, i));
    EXPECT_NEAR(*standard_error(sum(one, one), i),
                *standard_error(one, i) / std::sqrt(2.0),
                1e-9 * *standard_error(one, i));
  }
  EXPECT_EQ(sum({}, one).matrix, one.matrix);
}

/// A record of a trial has the standard errors that the trial promises.
TEST_F(Plan, PromisesWhatARecordOfItKeeps) {  // [I-20]
  std::vector<Record> record = {
      made_record(setup, steel(), {.per_turn = 90, .turns = 6.0, .noise = 0.5})};
  const Fit fit =
      identify(without_runout(setup), steel(), record, {.errors = Errors::white});
  ASSERT_TRUE(fit.ok) << fit.message;
  Trial same = trial();
  same.turns = 6.0;
  same.noise = 1.0;
  const Information promised = information_of(same);
  const double scale = fit.rms * std::sqrt(540.0 / fit.freedom);  // the noise found
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_NEAR(scale * *standard_error(promised, c) / fit.coefficients[c]->se, 1.0,
                1e-3)
        << c;
  }
  EXPECT_NEAR(scale * *standard_error(promised, 7) / *fit.radial_offsets_se[2], 1.0,
              1e-3);
}

TEST_F(Plan, DeterminantOfOneIsItsVariance) {  // [I-21]
  const Information known = information_of(trial());
  const std::size_t one = 3;
  EXPECT_NEAR(*log_determinant(known, {&one, 1}),
              2.0 * std::log(*standard_error(known, one)), 1e-9);
  // Of two: that of the first, and that of the second where the first is known.
  const std::vector<std::size_t> both = {3, 6};
  Information first_known = known;
  first_known.matrix[3 * known.size + 3] *= 1e9;
  const std::size_t second = 6;
  EXPECT_NEAR(*log_determinant(known, both),
              *log_determinant(known, {&one, 1}) +
                  2.0 * std::log(*standard_error(first_known, second)),
              1e-6);
}

TEST_F(Plan, SaysWhatIsNotDetermined) {  // [I-21]
  Trial straight = trial();
  straight.setup = slot_setup(2, 0.0, 2.0 * unit::mm);
  straight.setup.runout.eccentricity = 5 * unit::um;
  straight.setup.runout.order = geometry::EccentricityOrder::first;
  straight.options.runout = RunoutUnknowns::eccentricity;
  straight.options.phase = 0.0;
  const Information known = information_of(straight);
  ASSERT_EQ(known.size, 8U);
  const std::vector<std::size_t> both = {6, 7};
  EXPECT_TRUE(standard_error(known, 6).has_value());
  EXPECT_FALSE(standard_error(known, 7).has_value()) << "e_y of two straight teeth";
  EXPECT_FALSE(log_determinant(known, both).has_value());
  EXPECT_FALSE(standard_error({}, 0).has_value());
}

Knowledge nothing_measured(const Trial& trial) {
  return {.trial = trial, .information = {}, .freedom = 0.0};
}

/// The cut of a trial with another axial depth.
geometry::Cut with_depth(const Trial& trial, double a_p) {
  geometry::Cut cut = trial.setup.cut;
  cut.a_p = a_p;
  return cut;
}

TEST_F(Plan, PutsTheCutThatTellsMostFirst) {  // [I-21]
  const Knowledge known = nothing_measured(trial());
  const CutPlan plan =
      next_cut(known, {.cuts = {with_depth(known.trial, 1e-3), known.trial.setup.cut},
                       .quantities = {"coefficients"},
                       .max_force = {}});
  ASSERT_EQ(plan.cuts.size(), 2U);
  EXPECT_EQ(plan.cuts[0].cut.a_p, 2e-3);
  EXPECT_LT(plan.cuts[0].log_determinant, plan.cuts[1].log_determinant);
  EXPECT_LT(plan.cuts[0].se[0], plan.cuts[1].se[0]);
  EXPECT_EQ(plan.parameters, 6U);
  EXPECT_EQ(plan.quantities[0].key, "K_tc_MPa");
  EXPECT_FALSE(plan.quantities[0].se.has_value());
}

TEST_F(Plan, SaysWhyCutsAreLeftOut) {
  const Knowledge known = nothing_measured(trial());
  const geometry::Cut& cut = known.trial.setup.cut;
  const CutPlan plan =
      next_cut(known, {.cuts = {cut, with_depth(known.trial, 1e-3)},
                       .quantities = {"K_tc"},
                       .max_force = 0.75 * peak_in_plane(known.trial)});
  ASSERT_EQ(plan.cuts.size(), 1U);
  EXPECT_EQ(plan.cuts[0].cut.a_p, 1e-3);
  ASSERT_EQ(plan.left_out.size(), 1U);
  EXPECT_EQ(plan.left_out[0].count, 1U);
  EXPECT_EQ(plan.left_out[0].reason.substr(0, 15), "above max_force");
}

TEST_F(Plan, OfWhatNoFitLooksForIsEmpty) {
  const Knowledge known = nothing_measured(trial());
  const CutPlan plan = next_cut(
      known, {.cuts = {known.trial.setup.cut}, .quantities = {"m_c"}, .max_force = {}});
  EXPECT_TRUE(plan.quantities.empty());
  EXPECT_TRUE(plan.cuts.empty());
}

TEST_F(Plan, GoesOnFromWhatAFitKnows) {  // [I-20]
  const force::Setup start = without_runout(setup);
  const Fit fit = identify(start, steel(), runs, {.errors = Errors::white});
  ASSERT_TRUE(fit.ok) << fit.message;
  const Knowledge known = knowledge_of(start, steel(), runs, fit);
  EXPECT_EQ(known.freedom, fit.freedom);
  EXPECT_EQ(known.trial.setup.runout.radial_offsets, fit.runout.radial_offsets);
  EXPECT_TRUE(untold_coefficients(known).empty());
  const CutPlan plan = next_cut(
      known,
      {.cuts = {known.trial.setup.cut}, .quantities = {"K_tc"}, .max_force = {}});
  ASSERT_EQ(plan.cuts.size(), 1U);
  EXPECT_LT(plan.cuts[0].se[0], *plan.quantities[0].se);
}

}  // namespace trochoid::identification::plan_test
