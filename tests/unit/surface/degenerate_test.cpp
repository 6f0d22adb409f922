#include "made_readings.h"

#include <gtest/gtest.h>

#include <utility>

/// What the data cannot tell apart is refused, never inverted.
namespace trochoid::surface::degenerate_test {

constexpr Coefficients K = {800e6, 300e6, 0.0, 0.0};

void expect_refused(const CoefficientFit& a) {
  EXPECT_FALSE(a.ok);
  EXPECT_LT(a.rank, 2);
  EXPECT_FALSE(a.message.empty());
}

/// The combination that is known must hold the truth.
void expect_combination(const CoefficientFit& a) {
  ASSERT_NEAR(std::hypot(a.known[0], a.known[1]), 1.0, 1e-9);
  const double truth = a.known[0] * K[0] + a.known[1] * K[1];
  EXPECT_NEAR(a.combination.value, truth, 1e-3 * std::abs(truth));
}

Setting concentrated(Model model, const MadeCut& cut = made_cut()) {
  Setting s = made_setting(model, cut);
  s.load = Load::concentrated;
  return s;
}

TEST(Degenerate, OnePlaceIsOneEquation) {  // [E-15]
  const Setting s = made_setting(Model::quasi_static);
  auto readings = pulses(s, K, {.heights = {0.5e-3}});
  std::erase_if(readings, [](const Reading& r) {
    return std::abs(std::remainder(r.travel - 0.06e-3, 0.2e-3)) > 1e-9;
  });
  ASSERT_EQ(readings.size(), 3U);
  const ModelFits c = fitted(s, readings);
  ASSERT_EQ(c.fits.size(), 1U);
  EXPECT_FALSE(c.fits[0].ok);
  EXPECT_FALSE(c.fits[0].message.empty());
}

/// Three readings at three heights: any two coefficients and an offset fit them exactly.
TEST(Degenerate, FewerThanThreeReadingsToSpareAreRefused) {  // [E-15]
  const Setting s = made_setting(Model::imprint);
  for (const int count : {3, 5}) {
    auto readings = imprints(s, K, {.heights = made_heights(count)});
    std::erase_if(readings, [last = -1.0](const Reading& r) mutable {
      return r.height == std::exchange(last, r.height);
    });
    ASSERT_EQ(static_cast<int>(readings.size()), count);
    EXPECT_EQ(chosen_fit(fitted(s, readings)).ok, count >= 2 + 3) << count;
    const auto with_offset = chosen_fit(fitted(s, readings, {.offset = true}));
    EXPECT_FALSE(with_offset.ok) << count;
    EXPECT_NE(with_offset.message.find("for 3 unknowns: at least 6 are needed"),
              std::string::npos)
        << with_offset.message;
  }
}

TEST(Degenerate, OneMomentAtManyHeightsUnderAConcentratedLoad) {  // [E-15]
  const Setting s = concentrated(Model::quasi_static);
  auto readings = pulses(s, K, {.heights = made_heights(11)});
  std::erase_if(readings, [](const Reading& r) {
    return std::abs(std::remainder(r.travel - 0.06e-3, 0.2e-3)) > 1e-9;
  });
  const CoefficientFit a = chosen_fit(fitted(s, readings));
  EXPECT_EQ(a.rank, 1);
  expect_refused(a);
  expect_combination(a);
}

TEST(Degenerate, AConstantForce) {  // [E-15] a_p one axial pitch
  for (const Model model : {Model::quasi_static, Model::imprint}) {
    MadeCut cut = made_cut();
    cut.cut.a_p = pi * 12e-3 / 3;
    const Setting s = concentrated(model, cut);
    const Measured at{.heights = made_heights(7, cut.cut.a_p)};
    const auto readings =
        model == Model::imprint ? imprints(s, K, at) : pulses(s, K, at);
    const CoefficientFit a = chosen_fit(fitted(s, readings));
    EXPECT_EQ(a.rank, 1);
    expect_refused(a);
    expect_combination(a);
  }
}

TEST(Degenerate, AFullSlotOfAnEvenNumberOfTeethHidesTheRadialForce) {  // [E-15]
  for (const int teeth : {4, 6}) {
    for (const bool down : {true, false}) {
      MadeCut cut = made_cut(down, teeth);
      if (down) {
        cut.cut.engagement = geometry::DownMilling{12e-3};
      } else {
        cut.cut.engagement = geometry::UpMilling{12e-3};
      }
      const Setting s = concentrated(Model::quasi_static, cut);
      const CoefficientFit a =
          chosen_fit(fitted(s, pulses(s, K, {.heights = {1e-3, 2e-3}})));
      EXPECT_EQ(a.rank, 1) << a.condition;
      expect_refused(a);
      EXPECT_NEAR(std::abs(a.known[0]), 1.0, 1e-2);  // K_tc alone
      expect_combination(a);
    }
  }
}

TEST(Degenerate, AnImprintWithoutHelixShowsNoForce) {  // [E-15]
  for (const bool down : {true, false}) {
    const Setting s = made_setting(Model::imprint, made_cut(down, 3, 0.0));
    auto readings = imprints(s, K);
    for (const Reading& r : readings) EXPECT_NEAR(r.error, 0.0, 1e-12);
    add_noise(readings, 1e-6, 3);
    expect_refused(chosen_fit(fitted(s, readings)));
  }
}

TEST(Degenerate, ImprintsAtOneHeight) {  // [E-15]
  const Setting s = made_setting(Model::imprint);
  Measured at{.heights = {1e-3}};
  at.places = {10e-3, 20e-3, 30e-3};
  const CoefficientFit a = chosen_fit(fitted(s, imprints(s, K, at)));
  EXPECT_EQ(a.rank, 1);
  expect_refused(a);
  expect_combination(a);
}

TEST(Degenerate, PlacesAlongAWallDoNotReplaceHeights) {  // [E-15] cond 1.8e3
  const Setting s = made_setting(Model::imprint, made_cut(), with_wall());
  Measured at{.heights = {1e-3}};
  at.places = {10e-3, 20e-3, 30e-3};
  auto readings = imprints(s, K, at);
  add_noise(readings, 1e-6, 5);
  const CoefficientFit a = chosen_fit(fitted(s, readings));
  expect_refused(a);
  EXPECT_GT(a.condition, 1000.0);
}

TEST(Degenerate, TwoHeightsAndAnOffsetAreTooFew) {  // [E-15]
  const Setting s = made_setting(Model::imprint);
  const CoefficientFit a = chosen_fit(
      fitted(s, imprints(s, K, {.heights = {0.5e-3, 1.5e-3}}), {.offset = true}));
  EXPECT_FALSE(a.ok);
  EXPECT_EQ(a.message, "2 means of readings for 3 unknowns");
}

TEST(Degenerate, AsManyMeansAsUnknownsLeaveTheErrorsOpen) {  // [E-15]
  const Setting s = made_setting(Model::imprint);
  const CoefficientFit a =
      chosen_fit(fitted(s, imprints(s, K, {.heights = {0.5e-3, 1.5e-3}})));
  ASSERT_TRUE(a.ok);
  EXPECT_NEAR(a.K_tc.value, K[0], 1e-4 * K[0]);
  EXPECT_TRUE(std::isnan(a.K_tc.se));
}

TEST(Degenerate, AllZeroReadingsAreZeroCoefficients) {  // [E-15] [E-16]
  for (const Model model : {Model::quasi_static, Model::imprint}) {
    const Setting s = made_setting(model);
    auto readings =
        model == Model::imprint ? imprints(s, K) : pulses(s, K, {.heights = {1e-3}});
    for (Reading& r : readings) r.error = 0.0;
    const ModelFits c = fitted(s, readings);
    ASSERT_TRUE(chosen_fit(c).ok) << chosen_fit(c).message;
    EXPECT_EQ(chosen_fit(c).rank, 2);
    EXPECT_NEAR(chosen_fit(c).K_tc.value, 0.0, 1e-3);
    EXPECT_NEAR(chosen_fit(c).K_rc.value, 0.0, 1e-3);
    EXPECT_NEAR(chosen_fit(c).K_tc.se, 0.0, 1e-3);
  }
}

TEST(Degenerate, ASingleToothIsNotTakenForRunout) {  // [E-17]
  const Setting s =
      made_setting(Model::imprint, with_runout(made_cut(true, 1), 5e-6, 0.3));
  const auto readings = imprints(s, K);
  const ModelFits c = fitted(s, readings);
  ASSERT_TRUE(chosen_fit(c).ok);
  // the mean is the tooth: its runout is in the coefficients
  EXPECT_GT(std::abs(chosen_fit(c).K_tc.value / K[0] - 1), 0.01);
  const RunoutFit r = find_runout(s, readings, std::array{Datum{}}, c);
  EXPECT_FALSE(r.ok);
  EXPECT_NE(r.message.find("one tooth"), std::string::npos);
}

TEST(Degenerate, ReadingsOutOfTheCutSayNothingAndDoNoHarm) {  // [E-15]
  // most of a pulse is zero whatever K: those rows leave variance and rank alone
  const Setting s = made_setting(Model::quasi_static, made_cut(true, 1));
  auto readings = pulses(s, K, {.heights = {0.5e-3}, .per_tooth = 24});
  add_noise(readings, 1e-6, 2);
  const CoefficientFit all = chosen_fit(fitted(s, readings));
  auto some = readings;
  std::erase_if(some, [](const Reading& r) {
    const double phi = r.travel / 0.2e-3 * 360;
    return phi < 110 || phi > 220;
  });
  ASSERT_LT(some.size(), readings.size());
  const CoefficientFit few = chosen_fit(fitted(s, some));
  EXPECT_NEAR(all.K_tc.value, few.K_tc.value, 1e-6 * K[0]);
  EXPECT_NEAR(all.K_tc.se, few.K_tc.se, 1e-6 * K[0]);
}

TEST(Degenerate, AReadingThatTheTiltLeavesAloneStillCounts) {  // [E-15]
  // the middle height: tilted by nothing, but bent by the coefficients
  const Setting s = made_setting(Model::imprint);
  auto readings = imprints(s, K, {.heights = {0.5e-3, 1.25e-3, 2e-3}});
  for (Reading& r : readings) {
    r.error += 0.01 * (r.height - 1.25e-3);
    if (r.height == 1.25e-3) r.error += 5e-6;
  }
  const CoefficientFit a = chosen_fit(fitted(s, readings, {.tilt = true}));
  ASSERT_TRUE(a.ok) << a.message;
  EXPECT_LT(a.rms, 1e-9);  // three means, three unknowns: all are met
  EXPECT_GT(std::abs(a.K_tc.value / K[0] - 1), 0.01);
}

TEST(Degenerate, NoReadingAtAllIsNoCrash) {  // [E-11]
  EXPECT_TRUE(nominal_errors({}, Model::imprint, 0.2e-3, 3).empty());
}

TEST(Degenerate, TheTopAndTheTipOfTheCutAreHeights) {  // [E-15]
  for (const Model model : {Model::imprint, Model::envelope}) {
    const Setting s = made_setting(model, made_cut(), with_wall());
    Measured at{.heights = {0.0, 0.5e-3, 1e-3, 2e-3, 3e-3}};
    const auto readings =
        model == Model::imprint ? imprints(s, K, at) : profiles(s, K, at);
    const CoefficientFit a = chosen_fit(fitted(s, readings));
    ASSERT_TRUE(a.ok) << a.message;
    EXPECT_NEAR(a.K_tc.value, K[0], 0.02 * K[0]);
  }
}

TEST(Degenerate, AWholeSlotWideCutIsAnUpOrDownCutStill) {  // [E-12]
  const Setting s = made_setting(Model::imprint, [] {
    MadeCut cut = made_cut();
    cut.cut.engagement = geometry::DownMilling{12e-3};
    return cut;
  }());
  const CoefficientFit a = chosen_fit(fitted(s, imprints(s, K)));
  ASSERT_TRUE(a.ok) << a.message;
  EXPECT_NEAR(a.K_tc.value, K[0], 1e-4 * K[0]);
}

}  // namespace trochoid::surface::degenerate_test
