#include "made_readings.h"

#include <trochoid/surface/calibrate.h>
#include <trochoid/surface/doubts.h>

#include <gtest/gtest.h>

#include <random>

#include <stdexcept>

namespace trochoid::surface::calibrate_test {

constexpr Coefficients K = {800e6, 300e6, 0.0, 0.0};

/// Of readings whose runout is not told.
Calibration calibration(const Setting& s, const std::vector<Reading>& readings,
                        Feedback feedback = Feedback::none, Datum datum = {}) {
  Setting blind = s;
  blind.setup.runout = {.order = s.setup.runout.order};
  return calibrate(blind, readings, std::array{datum}, {.feedback = feedback});
}

Setting with_eccentricity(Model model) {
  return made_setting(model, with_runout(made_cut(), 5e-6, 3.5));
}

std::vector<Reading> profile(const Setting& s) {
  return profiles(s, K, {.heights = made_heights(4), .per_tooth = 8});
}

TEST(Calibrate, OfAnEnvelopeTheFitWithRunoutCounts) {  // [E-16] [E-17]
  const Setting s = with_eccentricity(Model::envelope);
  const Calibration c = calibration(s, profile(s));
  ASSERT_TRUE(c.ok) << c.message;
  EXPECT_TRUE(c.runout_seen);
  EXPECT_TRUE(c.with_runout);
  EXPECT_EQ(c.coefficients.K_tc.value, c.runout.K_tc.value);
  EXPECT_EQ(c.coefficients.rms, c.runout.rms);
  EXPECT_NE(c.coefficients.K_tc.value, chosen_fit(c.models).K_tc.value);
  EXPECT_NEAR(c.coefficients.K_tc.value, K[0], 0.02 * K[0]);
  EXPECT_EQ(c.predicted, c.runout.predicted);
}

TEST(Calibrate, WithFeedbackTheMeansCount) {  // [E-10] [E-16]
  const Setting s = with_eccentricity(Model::envelope);
  const Calibration c = calibration(s, profile(s), Feedback::entry);
  ASSERT_TRUE(c.ok) << c.message;
  EXPECT_TRUE(c.runout_seen);
  EXPECT_FALSE(c.with_runout);
  EXPECT_EQ(c.coefficients.K_tc.value, chosen_fit(c.models).K_tc.value);
  EXPECT_EQ(c.coefficients.rms, chosen_fit(c.models).rms);
}

TEST(Calibrate, OfImprintsTheMeansCount) {  // [E-11] [E-15]
  const Setting s = with_eccentricity(Model::imprint);
  const auto readings = imprints(s, K);
  const Calibration c = calibration(s, readings, Feedback::none, {.offset = true});
  ASSERT_TRUE(c.ok) << c.message;
  EXPECT_TRUE(c.runout_seen);
  EXPECT_FALSE(c.with_runout);
  EXPECT_EQ(c.coefficients.K_tc.value, chosen_fit(c.models).K_tc.value);
  EXPECT_EQ(c.coefficients.datum.size(), 1U);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    EXPECT_NEAR(c.predicted[i], readings[i].error, 1e-9);
  }
}

TEST(Calibrate, RunoutBelowThreeStandardErrorsIsNotSeen) {
  RunoutFit runout{.ok = true, .eccentricity = {.value = 2.9e-6, .se = 1e-6}};
  EXPECT_FALSE(is_seen(runout));
  runout.eccentricity.value = 3.1e-6;
  EXPECT_TRUE(is_seen(runout));
  runout.ok = false;
  EXPECT_FALSE(is_seen(runout));
}

/// Each measurement has a zero of its own, far from the other's or not.
TEST(Calibrate, AZeroFarFromTheOthersIsNoOutlier) {  // [E-26]
  const Setting s = with_eccentricity(Model::envelope);
  std::vector<Reading> readings = profile(s);
  const std::size_t first = readings.size();
  for (std::size_t i = 0; i < first; i += 9) {
    readings.push_back(readings[i]);
    readings.back().set = 1;
    readings.back().error += 20e-3;
  }
  Setting blind = s;
  blind.setup.runout = {.order = s.setup.runout.order};
  const Calibration c =
      calibrate(blind, readings, std::array{Datum{}, Datum{.offset = true}},
                {.feedback = Feedback::none, .robust = true});
  ASSERT_TRUE(c.ok) << c.message;
  EXPECT_TRUE(c.outliers.empty());
}

TEST(Calibrate, ReadingsOfZeroHaveNoRunoutToLookFor) {
  const Setting s = made_setting(Model::imprint);
  auto readings = imprints(s, K);
  for (Reading& r : readings) r.error = 0.0;
  int looked = 0;
  const Calibration c =
      calibrate(s, readings, std::array{Datum{}}, {}, [&] { ++looked; });
  EXPECT_TRUE(c.ok);
  EXPECT_EQ(c.runout.message, "all readings are zero");
  EXPECT_EQ(looked, 0);
  EXPECT_EQ(c.predicted.size(), readings.size());
}

TEST(Calibrate, WithoutRunoutAReadingIsHeldAgainstItsMean) {  // [E-11]
  const Setting s = made_setting(Model::imprint, made_cut(true, 1));
  const auto readings = imprints(s, K);
  const Calibration c = calibration(s, readings);
  ASSERT_TRUE(c.ok) << c.message;
  EXPECT_FALSE(c.runout.ok);
  EXPECT_EQ(c.predicted, predicted_means(c.models, readings.size()));
  EXPECT_NEAR(c.predicted.front(), readings.front().error, 1e-9);
}

TEST(Calibrate, SaysWhyThereAreNoCoefficients) {  // [E-15]
  const Setting s = made_setting(Model::imprint);
  int looked = 0;
  const Calibration c = calibrate(s, imprints(s, K, {.heights = {1e-3}}),
                                  std::array{Datum{}}, {}, [&] { ++looked; });
  EXPECT_FALSE(c.ok);
  EXPECT_EQ(c.message, chosen_fit(c.models).message);
  EXPECT_FALSE(c.message.empty());
  EXPECT_FALSE(c.runout_seen || c.with_runout);
  EXPECT_EQ(looked, 0);
}

TEST(Calibrate, ASlotHasNoSingleWall) {
  MadeCut slot = made_cut();
  slot.cut.engagement = geometry::Slot{};
  const std::vector<Reading> readings = {{.height = 1e-3, .error = 1e-6}};
  EXPECT_THROW(
      static_cast<void>(calibration(made_setting(Model::imprint, slot), readings)),
      std::invalid_argument);
}

TEST(Calibrate, MeansScatterAsManyAsTheyAre) {  // [E-20] [E-21]
  // One tooth shows no runout: the means are fitted, and their number counts, not that
  // of the readings in them.
  Setting s = made_setting(Model::envelope);
  s.setup = made_cut(true, 1);
  auto readings =
      profiles(s, K, {.places = {30e-3}, .labelled = false, .per_tooth = 12});
  std::mt19937 random(3);
  std::normal_distribution<double> shared(0.0, 1e-6);
  double height = -1.0;
  double off = 0.0;
  for (Reading& r : readings) {
    off = r.height != height ? shared(random) : off;
    height = r.height;
    r.error += off;
  }
  const std::array datum{Datum{}};
  const Calibration means = calibrate(s, readings, datum);
  const Calibration joint = calibrate(s, readings, datum, {.shared = true});
  ASSERT_TRUE(means.ok && joint.ok);
  EXPECT_FALSE(joint.with_runout);
  EXPECT_NEAR(joint.coefficients.K_tc.se / means.coefficients.K_tc.se, 1.0, 0.1);
}

TEST(Doubts, OfReadingsWithTheWrongSignNameTheRightCoefficients) {
  const Setting s = made_setting(Model::imprint, made_cut());
  std::vector<Reading> readings = imprints(s, K);
  EXPECT_FALSE(negative_coefficients(s, readings, calibration(s, readings)));
  for (Reading& r : readings) r.error = -r.error;
  const auto doubt = negative_coefficients(s, readings, calibration(s, readings));
  ASSERT_TRUE(doubt.has_value());
  EXPECT_TRUE(doubt->wrong_sign);
  EXPECT_NEAR(doubt->K_tc.value, K[0], 0.02 * K[0]);
}

TEST(Doubts, OfReadingsWhereTheCutterWasThereAreNone) {
  const Setting s = made_setting(Model::imprint, made_cut());
  const auto readings = imprints(s, K);  // all at 30 mm
  const Calibration c = calibration(s, readings);
  EXPECT_FALSE(origin_doubt(s, readings, c, 60e-3, 30e-3).has_value());
  EXPECT_FALSE(origin_doubt(s, {}, c, 60e-3, 30e-3).has_value());
}

}  // namespace trochoid::surface::calibrate_test
