#include "correct_case.h"

#include <trochoid/run/correct.h>

namespace trochoid::run::warnings_test {

using Codes = std::vector<std::string>;
using test::codes;

/// A measured setting that is to be believed.
correction::Setting measured() {
  correction::Setting s;
  s.fit = correction::StaticFit{.ok = true, .explained = 0.99};
  s.behind = correction::TrueRunout{.ok = true, .reason = "it chatters"};
  return s;
}

Codes of_setting(const correction::Setting& s) {
  std::vector<base::Warning> warnings;
  add_setting_warnings(s, warnings);
  return codes(warnings);
}

/// A correction that leaves nothing to say.
correction::Correction sound() {
  correction::Correction c{.ok = true};
  c.setting.rho = c.setting.designed_for = {10e-6, -10e-6};
  for (correction::MovedCut* cut : {&c.cuts.before, &c.cuts.after}) {
    cut->motion.passes = 2;
    cut->motion.flutes = {{.peak_y = 50, .chip_area = 1e-4},
                          {.peak_y = 50, .chip_area = 0.95e-4}};
  }
  c.axes = {.uncorrected = 10e-6, .one_axis = 1e-6, .two_axes = 0, .most_teeth = 2};
  return c;
}

std::vector<base::Warning> of(const correction::Correction& c) {
  std::vector<base::Warning> warnings;
  add_correction_warnings(c, warnings);
  return warnings;
}

TEST(SettingWarnings, AreOfMeasuredForcesOnly) {
  EXPECT_TRUE(of_setting({}).empty());
  EXPECT_TRUE(of_setting(measured()).empty());
}

TEST(SettingWarnings, SayThatAFitIsPoorAndComplianceIsLeft) {
  correction::Setting s = measured();
  s.fit->explained = 0.8;
  EXPECT_EQ(of_setting(s), Codes{"poor_fit"});
  s.behind->ok = false;
  std::vector<base::Warning> warnings;
  add_setting_warnings(s, warnings);
  EXPECT_EQ(codes(warnings), (Codes{"poor_fit", "compliance_not_removed"}));
  EXPECT_NE(warnings[1].message.find("it chatters"), std::string::npos);
}

TEST(CorrectionWarnings, AreNoneWhereAllIsWell) {
  EXPECT_TRUE(of(sound()).empty()) << codes(of(sound())).front();
}

TEST(CorrectionWarnings, NameEveryLimitThatIsBroken) {
  correction::Correction c = sound();
  c.plan.limits.limits = {{.reason = "kept"},
                          {.known = false, .ok = false, .reason = "not known"},
                          {.ok = false, .reason = "broken"}};
  const auto warnings = of(c);
  ASSERT_EQ(codes(warnings), Codes{"beyond_limit"});
  EXPECT_EQ(warnings[0].message, "broken");
}

TEST(CorrectionWarnings, SayThatForcesStillChange) {
  correction::Correction c = sound();
  c.cuts.after.motion.passes.reset();
  c.cuts.after.motion.last_change = 1.5;
  const auto warnings = of(c);
  ASSERT_EQ(codes(warnings), Codes{"not_periodic"});
  EXPECT_NE(warnings[0].message.find("1.5 N"), std::string::npos);
}

TEST(CorrectionWarnings, SayThatEqualPeaksAreNotEqualChips) {
  correction::Correction c = sound();
  c.cuts.after.motion.flutes[1].chip_area = 0.5e-4;
  const auto warnings = of(c);
  ASSERT_EQ(codes(warnings), Codes{"unequal_chips"});
  EXPECT_NE(warnings[0].message.find("50 % (5 % before)"), std::string::npos)
      << warnings[0].message;
}

TEST(CorrectionWarnings, SayWhatOneAxisCannotDo) {
  correction::Correction c = sound();
  c.axes.one_axis = 2.1e-6;
  EXPECT_EQ(codes(of(c)), Codes{"several_teeth_in_cut"});
  c.axes.most_teeth = 1;
  EXPECT_TRUE(of(c).empty());
}

TEST(CorrectionWarnings, SayThatTheCommandIsForAReading) {
  correction::Correction c = sound();
  c.setting.designed_for = {9e-6, -9e-6};
  EXPECT_TRUE(of(c).empty()) << "nothing was read";
  c.setting.fit = correction::StaticFit{.ok = true};
  const auto warnings = of(c);
  ASSERT_EQ(codes(warnings), Codes{"static_estimate"});
  EXPECT_NE(warnings[0].message.find(": 18 um between"), std::string::npos)
      << warnings[0].message;
}

TEST(CorrectionWarnings, SayThatTheCutRanAway) {
  correction::Correction c = sound();
  c.controller = correction::ControllerInLoop{.ok = true};
  EXPECT_TRUE(of(c).empty());
  c.controller->finite = false;
  EXPECT_EQ(codes(of(c)), Codes{"ran_away"});
}

}  // namespace trochoid::run::warnings_test
