#include <trochoid/identification/problem.h>

#include "made_record.h"

#include <trochoid/identification/prepare.h>
#include <trochoid/identification/reliability.h>
#include <trochoid/identification/scan.h>

#include <gtest/gtest.h>

#include <cmath>

namespace trochoid::identification::groups_test {

force::LinearEdge worn() {
  return {2700e6, 1700e6, 340e6, 15e3, 17e3, 2e3};
}

/// A clamped tool of three teeth: two feeds in each of two states.
class Groups : public testing::Test {
 protected:
  void SetUp() override {
    setup = slot_setup(3, 30.0, 2.0 * unit::mm);
    setup.cut.engagement = geometry::UpMilling{3.0 * unit::mm};
    setup.runout.radial_offsets = {0.0, -8.0 * unit::um, 5.0 * unit::um};
  }

  [[nodiscard]] Record record(const force::LinearEdge& law, double f_z, double phase,
                              const std::string& group) const {
    force::Setup own = setup;
    own.cut.f_z = f_z;
    Record out = made_record(own, law,
                             {.phase = phase,
                              .per_turn = per_turn,
                              .noise = noise,
                              .seed = static_cast<unsigned>(1e6 * f_z + 10 * phase)});
    out.group = group;
    return out;
  }

  [[nodiscard]] std::vector<Record> two_states() const {
    return {record(steel(), 40e-6, 0.3, "new"), record(worn(), 40e-6, 2.9, "worn"),
            record(steel(), 70e-6, 1.1, "new"), record(worn(), 60e-6, -2.0, "worn")};
  }

  force::Setup setup;
  double noise = 0.0;
  int per_turn = 90;
};

TEST_F(Groups, EachHasItsCoefficientsAndAllTheRunout) {  // [I-19]
  const Fit fit = identify(without_runout(setup), steel(), two_states(), {});
  ASSERT_TRUE(fit.ok) << fit.message;
  ASSERT_EQ(fit.groups.size(), 2U);
  EXPECT_EQ(fit.groups[0].name, "new");
  EXPECT_EQ(fit.groups[1].runs, (std::vector<std::size_t>{1, 3}));
  const auto sharp = force::coefficients(force::Law{steel()});
  const auto blunt = force::coefficients(force::Law{worn()});
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_NEAR(fit.groups[0].coefficients[c]->value, sharp[c], 1e-6 * sharp[0]) << c;
    EXPECT_NEAR(fit.groups[1].coefficients[c]->value, blunt[c], 1e-6 * blunt[0]) << c;
    EXPECT_EQ(fit.coefficients[c]->value, fit.groups[0].coefficients[c]->value);
  }
  EXPECT_NEAR(fit.runout.radial_offsets[1], -8e-6, 1e-10);
  EXPECT_NEAR(fit.runout.radial_offsets[2], 5e-6, 1e-10);
  EXPECT_NEAR(fit.phase[3], -2.0, 1e-5);
  EXPECT_LT(fit.rms, 1e-4);
}

/// The rows of a band take another way through the derivatives by the phases.
TEST_F(Groups, AnswerAlikeWithinABand) {  // [I-19]
  noise = 5.0;
  per_turn = 1200;
  Options band;
  band.band_harmonics = 12;
  const Fit fit = identify(without_runout(setup), steel(), two_states(), band);
  ASSERT_TRUE(fit.ok) << fit.message;
  const auto blunt = force::coefficients(force::Law{worn()});
  for (std::size_t c = 0; c < 6; ++c) {
    const Estimate& found = *fit.groups[1].coefficients[c];
    EXPECT_NEAR(found.value, blunt[c], 5 * found.se) << c;
  }
  EXPECT_NEAR(fit.runout.radial_offsets[2], 5e-6, 5 * *fit.radial_offsets_se[2]);
}

TEST_F(Groups, OfOneNameAreTheFitWithoutGroups) {  // [I-19]
  noise = 10.0;
  std::vector<Record> runs = two_states();
  for (Record& run : runs) run.group.clear();
  const Fit none = identify(without_runout(setup), steel(), runs, {});
  for (Record& run : runs) run.group = "one";
  const Fit one = identify(without_runout(setup), steel(), runs, {});
  ASSERT_TRUE(one.ok) << one.message;
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_EQ(none.coefficients[c]->value, one.coefficients[c]->value);
    EXPECT_EQ(none.coefficients[c]->low, one.coefficients[c]->low);
  }
  EXPECT_EQ(none.runout.radial_offsets, one.runout.radial_offsets);
  EXPECT_EQ(none.fitted, one.fitted);
  EXPECT_GT(none.unexplained.all, 0.05) << "one set of coefficients does not fit both";
}

/// Each state told with the others knows the runout better than told alone.
TEST_F(Groups, HelpOneAnother) {  // [I-4]
  noise = 10.0;
  const std::vector<Record> runs = two_states();
  const std::vector<Record> sharp = {runs[0], runs[2]};
  const Fit both = identify(without_runout(setup), steel(), runs, {});
  const Fit alone = identify(without_runout(setup), steel(), sharp, {});
  ASSERT_TRUE(both.ok && alone.ok);
  EXPECT_LT(*both.radial_offsets_se[1], 0.9 * *alone.radial_offsets_se[1]);
}

/// The scan of all is that of each by itself: they have no phase and no coefficient in
/// common.
TEST_F(Groups, AddUpInTheScan) {  // [I-12] [I-19]
  noise = 10.0;
  const std::vector<Record> runs = two_states();
  const auto least = [&](const std::vector<Record>& some) {
    const Problem problem = *prepare(without_runout(setup), steel(), some, {}).problem;
    const Point truth{setup.runout, steel(), std::vector<double>(some.size(), 0.0)};
    std::vector<double> p = parameters_of(problem, truth);
    p.resize(2);
    return scan(problem, {p}).front().rss;
  };
  const double apart = least({runs[0], runs[2]}) + least({runs[1], runs[3]});
  EXPECT_NEAR(least(runs), apart, 1e-9 * apart);
}

TEST_F(Groups, AreNamedWhereTheyCannotBeTold) {
  std::vector<Record> runs = {record(steel(), 40e-6, 0.3, ""),
                              record(worn(), 0.0, 0.3, "idle")};
  for (auto& F : runs[1].force) F = {};
  const Fit fit = identify(without_runout(setup), steel(), runs, {});
  EXPECT_FALSE(fit.ok);
  EXPECT_NE(fit.message.find("of \"idle\""), std::string::npos) << fit.message;
  EXPECT_TRUE(refused(fit, "K_tc_MPa of \"idle\""));
  EXPECT_TRUE(refused(fit, "K_tc_MPa of the records without a group"));
}

TEST_F(Groups, AreJudgedOneByOne) {
  Fit fit;
  fit.law = steel();
  const Estimate good{1e9, 1e7, 0.9e9, 1.1e9};
  const Estimate bad{-1e9, 1e7, -1.1e9, -0.9e9};
  fit.coefficients.assign(6, good);
  EXPECT_TRUE(reasons_against(fit).empty());
  fit.groups = {{"new", {0}, steel(), {6, good}}, {"worn", {1}, steel(), {6, good}}};
  fit.groups[1].coefficients[1] = bad;
  EXPECT_EQ(reasons_against(fit),
            (std::vector<std::string>{"K_rc_MPa of \"worn\" is negative, which no cut "
                                      "does"}));
}

}  // namespace trochoid::identification::groups_test
