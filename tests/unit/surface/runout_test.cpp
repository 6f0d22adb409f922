#include "made_readings.h"

#include <gtest/gtest.h>

namespace trochoid::surface::runout_test {

constexpr Coefficients K = {800e6, 300e6, 0.0, 0.0};

RunoutFit found(const Setting& s, const std::vector<Reading>& readings,
                Datum datum = {}) {
  Setting blind = s;
  blind.setup.runout = {.order = s.setup.runout.order};
  const ModelFits c = fitted(blind, readings, datum);
  EXPECT_TRUE(chosen_fit(c).ok) << chosen_fit(c).message;
  return find_runout(blind, readings, std::array{datum}, c);
}

/// Distance of two angles, where one pitch more is the same answer.
double apart(double a, double b, double pitch) {
  return std::abs(std::remainder(a - b, pitch));
}

struct Kind {
  int teeth;
  bool down;
  double helix_deg;
  double rho;
  double angle;
};

class Teeth : public testing::TestWithParam<Kind> {};

TEST_P(Teeth, LabelledImprintsShowTheirRunout) {  // [E-17]
  const Kind k = GetParam();
  const Setting s =
      made_setting(Model::imprint,
                   with_runout(made_cut(k.down, k.teeth, k.helix_deg), k.rho, k.angle));
  const RunoutFit r = found(s, imprints(s, K, {.heights = made_heights(5)}));
  ASSERT_TRUE(r.ok) << r.message;
  EXPECT_TRUE(r.labelled);
  EXPECT_NEAR(r.eccentricity.value, k.rho, 1e-5 * k.rho);
  EXPECT_LT(apart(r.angle.value, k.angle, 2 * pi), 1e-4);
  EXPECT_NEAR(r.K_tc.value, K[0], 1e-3 * K[0]);
  EXPECT_NEAR(r.K_rc.value, K[1], 1e-3 * K[1]);
  EXPECT_LT(r.rms, 1e-10);
  EXPECT_GT(r.rms_without, 0.05 * k.rho);
}

TEST_P(Teeth, WithoutLabelsTheAngleIsKnownUpToAPitch) {  // [E-17]
  const Kind k = GetParam();
  const Setting s =
      made_setting(Model::imprint,
                   with_runout(made_cut(k.down, k.teeth, k.helix_deg), k.rho, k.angle));
  auto readings = imprints(s, K, {.heights = made_heights(5), .labelled = false});
  // the first reading is of tooth 2: the numbers are not those of the cutter
  for (Reading& r : readings) r.travel -= 2.0 * s.setup.cut.f_z;
  std::erase_if(readings, [&](const Reading& r) { return r.travel < 0; });
  const RunoutFit r = found(s, readings);
  ASSERT_TRUE(r.ok) << r.message;
  EXPECT_FALSE(r.labelled);
  EXPECT_NEAR(r.eccentricity.value, k.rho, 1e-5 * k.rho);
  EXPECT_LT(apart(r.angle.value, k.angle, 2 * pi / k.teeth), 1e-4);
}

TEST_P(Teeth, PulsesShowTheirRunout) {  // [E-17]
  const Kind k = GetParam();
  Setting s =
      made_setting(Model::quasi_static,
                   with_runout(made_cut(k.down, k.teeth, k.helix_deg), k.rho, k.angle));
  s.phase = 0.1;
  const auto readings = pulses(s, K, {.heights = {0.5e-3, 1.5e-3}});
  const RunoutFit r = found(s, readings);
  ASSERT_TRUE(r.ok) << r.message;
  EXPECT_NEAR(r.eccentricity.value, k.rho, 1e-4 * k.rho);
  EXPECT_LT(apart(r.angle.value, k.angle, 2 * pi), 1e-3);
  EXPECT_NEAR(r.K_tc.value, K[0], 1e-3 * K[0]);
}

INSTANTIATE_TEST_SUITE_P(
    Made, Teeth,
    testing::Values(Kind{2, true, 45, 3e-6, 0.4}, Kind{3, true, 45, 5e-6, 3.5},
                    Kind{4, true, 30, 20e-6, 6.0}, Kind{5, true, 20, 2e-6, 1.9},
                    Kind{2, false, 35, 8e-6, 5.0}, Kind{3, false, 45, 30e-6, 1.2},
                    Kind{5, false, 30, 4e-6, 2.7}));

TEST(FindRunout, RealProfilesShowIt) {  // [E-17]
  const Setting s =
      made_setting(Model::envelope, with_runout(made_cut(), 2e-6, 200 * unit::deg));
  const auto readings = profiles(s, K, {.heights = made_heights(4), .per_tooth = 8});
  const RunoutFit r = found(s, readings);
  ASSERT_TRUE(r.ok) << r.message;
  EXPECT_FALSE(r.labelled);
  EXPECT_NEAR(r.eccentricity.value, 2e-6, 0.03e-6);
  EXPECT_NEAR(r.K_tc.value, K[0], 0.02 * K[0]);
  EXPECT_LT(r.rms, 0.1e-6);
  EXPECT_LT(r.rms, 0.2 * r.rms_without);
}

TEST(FindRunout, AProbeReadsTheSameOfMeansAndOfReadings) {  // [E-13] [E-14] [E-17]
  // without runout, the mean of what is predicted one by one is the nominal error
  Setting s = made_setting(Model::envelope);
  s.probe_radius = 0.5e-3;
  const auto readings = profiles(s, K, {.heights = made_heights(4), .per_tooth = 32});
  const auto rows = nominal_errors(readings, s.model, s.setup.cut.f_z, 3);
  const auto nominal = NominalModel(s, rows).rigid(K);
  const ToothModel model(s, readings);
  const auto e = model.predict(model.forces({}), K, {}, 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double mean = 0.0;
    for (const std::size_t k : rows[i].readings) {
      mean += e[k] / static_cast<double>(rows[i].readings.size());
    }
    EXPECT_NEAR(mean, nominal.error[i], 20e-9) << rows[i].height;
  }
}

TEST(FindRunout, NoneIsFoundWhereThereIsNone) {  // [E-17]
  const Setting s = made_setting(Model::imprint);
  auto readings = imprints(s, K);
  add_noise(readings, 1e-6, 8);
  const RunoutFit r = found(s, readings);
  ASSERT_TRUE(r.ok) << r.message;
  EXPECT_LT(r.eccentricity.value, 4 * r.eccentricity.se);
}

TEST(FindRunout, TeethThatCutNothingAreNoObstacle) {  // [E-17] rho > f_z/2
  const Setting s =
      made_setting(Model::imprint, with_runout(made_cut(), 0.15e-3, 250 * unit::deg));
  const RunoutFit r = found(s, imprints(s, K));
  ASSERT_TRUE(r.ok) << r.message;
  EXPECT_NEAR(r.eccentricity.value, 0.15e-3, 1e-7);
  EXPECT_LT(apart(r.angle.value, 250 * unit::deg, 2 * pi), 1e-3);
  EXPECT_NEAR(r.K_tc.value, K[0], 0.01 * K[0]);
}

TEST(FindRunout, ADatumIsFittedAlong) {  // [E-17]
  const Setting s = made_setting(Model::imprint, with_runout(made_cut(), 5e-6, 3.5));
  auto readings = imprints(s, K);
  for (Reading& r : readings) r.error += 4e-6 + 1e-3 * (r.height - 1.5e-3);
  const RunoutFit r = found(s, readings, {.offset = true, .tilt = true});
  ASSERT_TRUE(r.ok) << r.message;
  EXPECT_NEAR(r.eccentricity.value, 5e-6, 1e-9);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    EXPECT_NEAR(r.predicted[i], readings[i].error, 1e-9);
  }
}

TEST(FindRunout, ATiltOfReadingsOverASingleTurnOfTheFeed) {  // [E-17] [E-11]
  // the means lie at one x, the readings do not: the datum must be the same in both
  const Setting s = made_setting(Model::imprint, with_runout(made_cut(), 5e-6, 3.5));
  auto readings = imprints(s, K);
  for (Reading& r : readings) r.x = r.travel;
  const RunoutFit r = found(s, readings, {.offset = true, .tilt = true});
  ASSERT_TRUE(r.ok) << r.message;
  EXPECT_NEAR(r.eccentricity.value, 5e-6, 1e-9);
}

TEST(FindRunout, StandardErrorsGoWithTheNoise) {  // [E-17]
  const Setting s = made_setting(Model::imprint, with_runout(made_cut(), 5e-6, 3.5));
  auto readings = imprints(s, K);
  add_noise(readings, 1e-6, 8);
  const RunoutFit r = found(s, readings);
  ASSERT_TRUE(r.ok) << r.message;
  // 33 readings, rho cos(...) of each: se = 1 um/sqrt(33/2), nearly orthogonal to K
  EXPECT_NEAR(r.eccentricity.se, 1e-6 / std::sqrt(16.5), 0.08e-6);
  EXPECT_NEAR(r.angle.se, r.eccentricity.se / r.eccentricity.value, 0.01);
  EXPECT_NEAR(r.eccentricity.value, 5e-6, 4 * r.eccentricity.se);
}

TEST(FindRunout, WithoutLabelsTheOrderMustBeClear) {  // [E-17]
  const Setting s = made_setting(Model::imprint, with_runout(made_cut(), 5e-6, 3.5));
  auto readings = imprints(s, K, {.labelled = false});
  readings[4].travel += 0.3 * 0.2e-3;
  const RunoutFit r = found(s, readings);
  EXPECT_FALSE(r.ok);
  EXPECT_NE(r.message.find("whole tooth feeds apart"), std::string::npos);
}

TEST(FindRunout, OneReadingAPlaceCannotShowIt) {  // [E-17]
  const Setting s = made_setting(Model::imprint);
  auto readings = imprints(s, K, {.labelled = false});
  std::erase_if(readings, [](const Reading& r) { return r.travel > 30.01e-3; });
  const RunoutFit r = found(s, readings);
  EXPECT_FALSE(r.ok);
  EXPECT_NE(r.message.find("less than 3 teeth need"), std::string::npos);
}

TEST(FindRunout, UnevenPitchesAreTaken) {  // [E-17]
  MadeCut cut = with_runout(made_cut(), 5e-6, 3.5);
  cut.cutter.pitch = {1.9, 2.2, 2 * pi - 4.1};
  for (const Model model : {Model::quasi_static, Model::imprint, Model::envelope}) {
    const Setting s = made_setting(model, cut);
    const Measured at{.heights = made_heights(3), .per_tooth = 3};
    const auto readings = model == Model::quasi_static ? pulses(s, K, at)
                          : model == Model::imprint    ? imprints(s, K, at)
                                                       : profiles(s, K, at);
    const ModelFits c = fitted(s, readings);
    const RunoutFit r = find_runout(s, readings, std::array{Datum{}}, c);
    EXPECT_TRUE(r.ok || !r.message.empty());
    EXPECT_TRUE(!r.ok || std::isfinite(r.eccentricity.value));
  }
}

}  // namespace trochoid::surface::runout_test
