#include <trochoid/run/commands.h>

#include "made_record_file.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace trochoid::run::plan_test {

using namespace test;
using cases::Command;
using results::PlanResult;

const auto silent = [](const std::string&) {};
const std::string one_model = "[identify]\nchip_models = [\"trochoidal\"]\n";

PlanResult planned(const std::string& text) {
  const CaseFolder folder;
  folder.write("record.csv", csv_text(two_turns(0.3, 4.0), Axis::angle));
  return plan(folder.read(cases::test::slot + text, Command::plan), silent);
}

bool warned(const PlanResult& r, const std::string& code) {
  return std::any_of(r.heading.warnings.begin(), r.heading.warnings.end(),
                     [&](const base::Warning& w) { return w.code == code; });
}

TEST(Plan, StartsFromWhatIdentifyAnswers) {
  const CaseFolder folder;
  folder.write("record.csv", csv_text(two_turns(0.3, 4.0), Axis::angle));
  const auto given =
      folder.read(cases::test::slot + measurement + one_model, Command::plan);
  const identification::Fit fit = identify(given, silent).fits.at(0);
  const PlanResult r = plan(given, silent);
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  ASSERT_EQ(r.quantities.size(), 3U);
  EXPECT_EQ(r.quantities[0].key, "K_tc_MPa");
  EXPECT_EQ(r.quantities[2].key, "radial_offset_2_mm");
  EXPECT_EQ(r.quantities[0].value, fit.coefficients[0]->value);
  EXPECT_NEAR(r.quantities[0].value + r.factor_before * *r.quantities[0].se,
              fit.coefficients[0]->high, 1e-6 * fit.coefficients[0]->high);
  EXPECT_NEAR(r.noise, 4.0, 0.5);
  EXPECT_EQ(r.noise_from, "records");
  EXPECT_EQ(r.looked_at, 45U);
  EXPECT_EQ(r.cuts.size(), 45U);
  EXPECT_TRUE(warned(r, "no_force_limit"));
  for (std::size_t i = 0; i < r.cuts.size(); ++i) {
    EXPECT_LT(r.cuts[i].se[0], *r.quantities[0].se) << "a cut cannot take away";
    if (i > 0) {
      EXPECT_GE(r.cuts[i].log_determinant, r.cuts[i - 1].log_determinant);
    }
  }
  EXPECT_TRUE(r.heading.message.starts_with("Cut next: ")) << r.heading.message;
}

/// What the records told is what identify says of them, and the next cut has no z either.
TEST(Plan, GoesWithoutAChannel) {
  const CaseFolder folder;
  folder.write("record.csv", csv_text(two_turns(0.3, 4.0), Axis::angle));
  const auto given =
      folder.read(cases::test::slot + measurement + "columns = [\"Fx_N\", \"Fy_N\"]\n" +
                      one_model + "[plan]\nquantities = [\"coefficients\"]\n",
                  Command::plan);
  const identification::Fit fit = identify(given, silent).fits.at(0);
  const PlanResult r = plan(given, silent);
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  EXPECT_TRUE(warned(r, "not_planned"));
  ASSERT_EQ(r.quantities.size(), 4U);
  EXPECT_EQ(r.quantities[2].key, "K_te_N_per_mm");
  EXPECT_NEAR(r.factor_before * *r.quantities[2].se,
              fit.coefficients[3]->high - fit.coefficients[3]->value,
              1e-5 * fit.coefficients[3]->value);
  for (const auto& cut : r.cuts) EXPECT_LT(cut.se[0], *r.quantities[0].se);
}

TEST(Plan, NeedsNoRecord) {
  const PlanResult r = planned("");
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  EXPECT_TRUE(warned(r, "nothing_measured"));
  EXPECT_FALSE(r.quantities[0].se.has_value());
  EXPECT_EQ(r.noise_from, "assumed");
  EXPECT_NE(r.heading.message.find("It tells K_tc to +- "), std::string::npos);
}

TEST(Plan, CountsWhatTheForceLeavesOut) {
  const PlanResult all = planned("[plan]\nnoise_N = 4\n");
  const PlanResult some = planned("[plan]\nnoise_N = 4\nmax_force_N = 350\n");
  EXPECT_FALSE(warned(some, "no_force_limit"));
  ASSERT_EQ(some.left_out.size(), 1U);
  EXPECT_EQ(some.left_out[0].reason, "above max_force_N = 350 N");
  EXPECT_EQ(some.left_out[0].count + some.cuts.size(), all.cuts.size());
  for (const auto& cut : some.cuts) {
    EXPECT_LE(cut.peak_force, 350);
  }
  const PlanResult none = planned("[plan]\nmax_force_N = 1e-3\n");
  EXPECT_FALSE(none.heading.ok);
  EXPECT_NE(none.heading.message.find("above max_force_N"), std::string::npos);
}

TEST(Plan, AsksForAnEccentricityByItsAmount) {
  const PlanResult r = planned(
      "[runout]\neccentricity_mm = 0.004\nangle_deg = 30\n"
      "[identify]\nrunout = \"eccentricity\"\n");
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  EXPECT_EQ(r.quantities.back().key, "eccentricity_mm");
  EXPECT_DOUBLE_EQ(r.quantities.back().value, 4e-6);
  EXPECT_EQ(r.parameters, 4U) << "both components count";
}

/// The whole tool is a plan for coefficients alone where the model feels no runout.
TEST(Plan, AsksForNoRunoutThatTheModelDoesNotFeel) {
  const PlanResult r = planned(
      measurement + "[identify]\nchip_models = [\"none\"]\n[plan]\nturns = 2\n");
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  EXPECT_EQ(r.parameters, 2U);
  EXPECT_EQ(r.quantities.size(), 2U);
}

TEST(Plan, HasNoAnswerWhereTheRecordsHaveNone) {
  const CaseFolder folder;
  auto record = two_turns();
  for (auto& F : record.force) {
    F = {1.0, 2.0, 3.0};
  }
  folder.write("record.csv", csv_text(record, Axis::angle));
  const PlanResult r = plan(
      folder.read(cases::test::slot + measurement + one_model, Command::plan), silent);
  EXPECT_FALSE(r.heading.ok);
  EXPECT_TRUE(r.heading.message.starts_with("the measurements so far"))
      << r.heading.message;
}

/// The tool as it is now is that of the last group.
TEST(Plan, IsForTheLastGroup) {
  const CaseFolder folder;
  const auto write = [&](const char* file, force::LinearEdge law) {
    folder.write(file, csv_text(identification::made_record(
                                    made_setup(), law,
                                    {.phase = 0.3, .per_turn = 180, .noise = 2.0}),
                                Axis::angle));
  };
  write("record.csv", made_law());
  force::LinearEdge worn = made_law();
  worn.K_tc *= 1.1;
  write("worn.csv", worn);
  const PlanResult r =
      plan(folder.read(cases::test::slot + measurement + "group = \"new\"\n" +
                           "[[measurement]]\nfile = \"worn.csv\"\ngroup = \"worn\"\n" +
                           one_model,
                       Command::plan),
           silent);
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  EXPECT_NEAR(r.quantities[0].value, worn.K_tc, 5 * *r.quantities[0].se);
  EXPECT_GT(r.quantities[0].value - made_law().K_tc, 5 * *r.quantities[0].se);
  EXPECT_EQ(r.group, "\"worn\"");
}

}  // namespace trochoid::run::plan_test
