#include "paper_case.h"

#include <trochoid/correction/setting.h>

#include <gtest/gtest.h>

#include <cmath>

namespace trochoid::correction::setting_test {

namespace {

/// The paper's cut, 27.8 um between its flutes: a rigid model reads about 26 um.
const double h_ro = 27.8e-6;

/// The last turn of a cut as a dynamometer has it, its angle wrong by an offset.
ForceRecord recorded(const MovingCut& cut, double offset, int turns_twice = 2) {
  const ForceRecord turn = moving_flutes(cut, Harmonics{}).record;
  ForceRecord record;
  const std::size_t half = turn.angle.size() / 2;
  for (std::size_t i = 0; i < half * static_cast<std::size_t>(turns_twice); ++i) {
    const std::size_t at = i % turn.angle.size();
    record.angle.push_back(static_cast<double>(i) * turn.angle[1] - offset);
    record.force.push_back(turn.force[at]);
  }
  return record;
}

/// The machine of a cut, with neither its law nor its runout.
MovingCut unknown_cut() {
  MovingCut cut = moving_case(0.0);
  cut.setup.runout = {};
  cut.law = force::Power{};
  return cut;
}

}  // namespace

TEST(KnownSetting, IsTheRunoutThatIsThere) {
  const Setting s = known_setting(moving_case(h_ro), {}, RunoutEstimate::known);
  ASSERT_TRUE(s.ok) << s.reason;
  EXPECT_NEAR(s.rho.at(0), h_ro / 2, 1e-12);
  EXPECT_NEAR(s.rho.at(1), -h_ro / 2, 1e-12);
  EXPECT_EQ(s.designed_for, s.rho);
  ASSERT_TRUE(s.fit) << "what would be read is told all the same";
  EXPECT_NEAR(s.fit->h_ro[0].value, 26e-6, 0.5e-6);
  EXPECT_FALSE(s.behind) << "nothing was measured";
  EXPECT_FALSE(s.ratio);
}

TEST(KnownSetting, MayBeDesignedForWhatARigidModelReads) {
  const Setting s = known_setting(moving_case(h_ro), {}, RunoutEstimate::static_fit);
  ASSERT_TRUE(s.ok) << s.reason;
  EXPECT_NEAR(s.rho.at(0), h_ro / 2, 1e-12);
  EXPECT_EQ(s.designed_for.at(0), s.fit->rho[0].value);
  EXPECT_LT(s.designed_for.at(0), 13.3e-6);
  EXPECT_NEAR(designed_cut(s).offsets().at(0), s.designed_for.at(0), 1e-12);
}

TEST(KnownSetting, ReadsNothingWithALawThatIsNoPowerLaw) {
  MovingCut cut = moving_case(h_ro);
  cut.law = force::LinearEdge{.K_tc = 1000e6, .K_rc = 350e6};
  const Setting s = known_setting(cut, {}, RunoutEstimate::known);
  EXPECT_TRUE(s.ok);
  EXPECT_FALSE(s.fit);
}

TEST(KnownSetting, SaysWhyNothingIsRead) {
  const Setting s = known_setting(moving_case(60e-6), {}, RunoutEstimate::static_fit);
  EXPECT_FALSE(s.ok) << "one flute of two does not cut";
  EXPECT_EQ(s.reason.find("a static fit finds no runout in the forces: "), 0U)
      << s.reason;
  EXPECT_TRUE(known_setting(moving_case(60e-6), {}, RunoutEstimate::known).ok);
}

TEST(MeasuredSetting, FindsLawAndRunoutBehindTheForces) {
  const MovingCut truth = moving_case(h_ro);
  const Setting s =
      measured_setting(unknown_cut(), {}, recorded(truth, 0.03), RunoutEstimate::known);
  ASSERT_TRUE(s.ok) << s.reason;
  ASSERT_TRUE(s.behind);
  EXPECT_TRUE(s.behind->ok) << s.behind->reason;
  EXPECT_NEAR(s.rho.at(0) - s.rho.at(1), h_ro, 0.4e-6);
  EXPECT_LT(s.fit->h_ro[0].value, 26.5e-6);
  EXPECT_EQ(s.designed_for, s.rho);
  EXPECT_EQ(s.cut.setup.runout.radial_offsets, s.rho);
  EXPECT_NEAR(std::get<force::Power>(s.cut.law).m_t, steep_law().m_t, 0.01);
  EXPECT_NEAR(s.angle_offset, 0.03, 0.01);
  ASSERT_TRUE(s.ratio);
  EXPECT_TRUE(s.ratio->ok);
  EXPECT_NEAR(s.ratio->h_ro[0], s.fit->h_ro[0].value, 2e-6);
}

TEST(MeasuredSetting, UsesWholeTurns) {
  const MovingCut truth = moving_case(h_ro);
  const auto from = [&](int turns_twice) {
    return measured_setting(unknown_cut(), {}, recorded(truth, 0.0, turns_twice),
                            RunoutEstimate::static_fit);
  };
  const Setting one = from(2);
  const Setting longer = from(3);
  ASSERT_TRUE(one.ok) << one.reason;
  EXPECT_EQ(longer.fit->samples, one.fit->samples);
  EXPECT_EQ(longer.designed_for, one.designed_for);
  EXPECT_EQ(one.designed_for.at(0), one.fit->rho[0].value);
  EXPECT_GT(from(4).fit->samples, one.fit->samples);
}

TEST(MeasuredSetting, KeepsTheReadingWhereTheComplianceIsNotTakenOut) {
  MovingCut soft = unknown_cut();
  for (dynamics::ChipMode& mode : soft.tool) {
    mode.stiffness /= 20;  // with it the cut would chatter, and the forces tell nothing
  }
  const Setting s = measured_setting(soft, {}, recorded(moving_case(h_ro), 0.0),
                                     RunoutEstimate::known);
  ASSERT_TRUE(s.ok) << s.reason;
  ASSERT_TRUE(s.behind);
  EXPECT_FALSE(s.behind->ok);
  EXPECT_FALSE(s.behind->reason.empty());
  EXPECT_EQ(s.rho.at(0), s.fit->rho[0].value);
}

TEST(MeasuredSetting, SaysWhyARecordTellsNothing) {
  const ForceRecord half = recorded(moving_case(h_ro), 0.0, 1);
  const auto reason = [](const ForceRecord& record) {
    const Setting s =
        measured_setting(unknown_cut(), {}, record, RunoutEstimate::known);
    EXPECT_FALSE(s.ok);
    return s.reason;
  };
  EXPECT_EQ(reason(half),
            "the record is 180 deg long; a correction needs a whole turn of the "
            "spindle at least");
  EXPECT_EQ(reason({}).find("the record is 0 deg long"), 0U);
  ForceRecord nothing = recorded(moving_case(h_ro), 0.0);
  nothing.force.assign(nothing.angle.size(), {});
  EXPECT_EQ(reason(nothing).find("runout was not found in the record: "), 0U);
}

}  // namespace trochoid::correction::setting_test
