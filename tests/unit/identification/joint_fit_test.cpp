#include "made_record.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trochoid::identification::joint_fit_test {

TEST(JointFit, OffsetPhaseAndCoefficientsComeBack) {  // [I-3]
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  Sampling sampling;
  sampling.phase = 1.0;
  const std::vector<Record> runs = {made_record(setup, steel(), sampling)};
  const Fit fit = identify(without_runout(setup), steel(), runs, {});
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_NEAR(fit.runout.radial_offsets[1], -8e-6, 1e-11);
  EXPECT_EQ(fit.runout.radial_offsets[0], 0.0);
  EXPECT_NEAR(fit.phase[0], 1.0, 1e-6);
  EXPECT_NEAR(fit.coefficients[0]->value, 2600e6, 1e3);
}

TEST(JointFit, GaugePutsThePhaseWithinHalfAPitch) {  // [I-3]
  for (const int teeth : {2, 3}) {
    force::Setup setup = slot_setup(teeth, 30.0, 2.0 * unit::mm);
    setup.runout.radial_offsets = {0.0, -8.0 * unit::um, 5.0 * unit::um};
    setup.runout.radial_offsets.resize(static_cast<std::size_t>(teeth));
    const double pitch = 2.0 * pi / teeth;
    Sampling sampling;
    sampling.phase = 0.3 + pitch;
    const std::vector<Record> runs = {made_record(setup, steel(), sampling)};
    const Fit fit = identify(without_runout(setup), steel(), runs, {});
    ASSERT_TRUE(fit.ok) << fit.message;
    EXPECT_NEAR(fit.phase[0], 0.3, 1e-4);
    // Tooth 2 of the record is tooth 1 of the answer. The common part of the offsets
    // changes the force by less than 1e-4 of a difference.
    const auto& made = setup.runout.radial_offsets;
    for (std::size_t k = 0; k < made.size(); ++k) {
      const double expected = made[(k + 1) % made.size()] - made[1];
      EXPECT_NEAR(fit.runout.radial_offsets[k], expected, 5e-9) << teeth << " " << k;
    }
  }
}

TEST(JointFit, StandardErrorOfTheOffsetIsThatOfRepetitions) {  // [I-4]
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  const int repetitions = 40;
  double sum = 0.0;
  double squares = 0.0;
  double se = 0.0;
  for (int i = 0; i < repetitions; ++i) {
    Sampling noisy;
    noisy.noise = 10.0;
    noisy.per_turn = 90;
    noisy.seed = 7U + static_cast<unsigned>(i);
    const std::vector<Record> runs = {made_record(setup, steel(), noisy)};
    const Fit fit = identify(without_runout(setup), steel(), runs, {});
    const double offset = fit.runout.radial_offsets[1];
    sum += offset;
    squares += offset * offset;
    se += *fit.radial_offsets_se[1] / repetitions;
  }
  const double mean = sum / repetitions;
  const double scatter =
      std::sqrt((squares - repetitions * mean * mean) / (repetitions - 1));
  // The scatter of 40 values is known to 11 %; three times that.
  EXPECT_NEAR(scatter / se, 1.0, 0.34);
}

TEST(JointFit, EccentricityOfThreeAndFourTeethComesBack) {  // [I-3]
  for (const int teeth : {3, 4}) {
    force::Setup setup = slot_setup(teeth, 30.0, 3.0 * unit::mm);
    setup.runout.eccentricity = 9.0 * unit::um;
    setup.runout.angle = 0.7;
    Sampling sampling;
    sampling.phase = 0.2;
    sampling.per_turn = 90;
    const std::vector<Record> runs = {made_record(setup, steel(), sampling)};
    Options options;
    options.runout = RunoutUnknowns::eccentricity;
    const Fit fit = identify(without_runout(setup), steel(), runs, options);
    ASSERT_TRUE(fit.ok) << fit.message;
    EXPECT_NEAR(fit.runout.eccentricity, 9e-6, 1e-10) << teeth;
    EXPECT_NEAR(fit.runout.angle, 0.7, 1e-5) << teeth;
    EXPECT_TRUE(fit.eccentricity_se.has_value());
    EXPECT_TRUE(fit.angle_se.has_value());
  }
}

class OneComponent : public testing::TestWithParam<double> {};

TEST_P(OneComponent, IsAllThatTwoTeethWithHardlyAnyLagShow) {  // [I-3]
  force::Setup setup = slot_setup(2, GetParam(), 2.0 * unit::mm);
  setup.runout.eccentricity = 5.0 * unit::um;
  setup.runout.angle = 0.5;
  Sampling noisy;
  noisy.noise = 1.0;
  noisy.per_turn = 90;
  const std::vector<Record> runs = {made_record(setup, steel(), noisy)};
  Options options;
  options.runout = RunoutUnknowns::eccentricity;
  options.phase = 0.0;
  const Fit fit = identify(without_runout(setup), steel(), runs, options);
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_FALSE(fit.eccentricity_se.has_value());
  EXPECT_FALSE(fit.angle_se.has_value());
  EXPECT_TRUE(refused(fit, "eccentricity_mm"));
  EXPECT_TRUE(refused(fit, "angle_deg"));
  EXPECT_NEAR(fit.runout.eccentricity * std::cos(fit.runout.angle),
              5e-6 * std::cos(0.5), 0.2e-6);
  EXPECT_TRUE(fit.coefficients[0].has_value());
}

INSTANTIATE_TEST_SUITE_P(HelixDeg, OneComponent, testing::Values(0.0, 1.0));

TEST(JointFit, TwoTeethWithALittleLagKeepBothComponents) {
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.eccentricity = 5.0 * unit::um;
  setup.runout.angle = 0.5;
  Sampling noisy;
  noisy.noise = 1.0;
  noisy.per_turn = 60;
  const std::vector<Record> runs = {made_record(setup, steel(), noisy)};
  Options options;
  options.runout = RunoutUnknowns::eccentricity;
  options.phase = 0.0;
  const Fit fit = identify(without_runout(setup), steel(), runs, options);
  ASSERT_TRUE(fit.ok) << fit.message;
  ASSERT_TRUE(fit.eccentricity_se && fit.angle_se);
  EXPECT_NEAR(fit.runout.eccentricity, 5e-6, 4.0 * *fit.eccentricity_se);
  EXPECT_NEAR(fit.runout.angle, 0.5, 4.0 * *fit.angle_se);
}

TEST(JointFit, ZeroHelixFindsThePhaseBetweenTheJumps) {  // [I-3]
  force::Setup setup = slot_setup(2, 0.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, 6.0 * unit::um};
  Sampling sampling;
  sampling.phase = 0.201;
  sampling.per_turn = 180;
  const std::vector<Record> runs = {made_record(setup, steel(), sampling)};
  const Fit fit = identify(without_runout(setup), steel(), runs, {});
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_NEAR(fit.phase[0], 0.201, 1e-6);
  EXPECT_NEAR(fit.runout.radial_offsets[1], 6e-6, 1e-10);
}

TEST(JointFit, TwoRunsShareCoefficientsAndRunout) {  // [I-3]
  force::Setup slow = slot_setup(2, 30.0, 2.0 * unit::mm);
  slow.runout.radial_offsets = {0.0, -8.0 * unit::um};
  force::Setup fast = slow;
  fast.cut.f_z = 70.0 * unit::um;
  Sampling first{0.2, 360, 2.0, 5.0, 1};
  Sampling second{2.9, 250, 1.5, 5.0, 2};
  const std::vector<Record> runs = {made_record(slow, steel(), first),
                                    made_record(fast, steel(), second)};
  const Fit both = identify(without_runout(slow), steel(), runs, {});
  ASSERT_TRUE(both.ok) << both.message;
  ASSERT_EQ(both.phase.size(), 2U);
  EXPECT_NEAR(both.phase[0], 0.2, 4.0 * *both.phase_se[0]);
  EXPECT_NEAR(both.phase[1], 2.9, 4.0 * *both.phase_se[1]);
  EXPECT_NEAR(both.runout.radial_offsets[1], -8e-6, 4.0 * *both.radial_offsets_se[1]);
  const Fit one = identify(without_runout(slow), steel(), {runs.data(), 1}, {});
  EXPECT_LT(both.coefficients[3]->se, one.coefficients[3]->se)
      << "two feeds tell cutting and edge coefficients apart better than one";
}

TEST(JointFit, PowerLawComesBackWithItsExponents) {  // [I-3]
  const force::Power law{1500e6, 700e6, 200e6, 0.25, 0.35, 0.3};
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  Sampling sampling;
  sampling.phase = -0.4;
  sampling.per_turn = 120;
  const std::vector<Record> runs = {made_record(setup, law, sampling)};
  const force::Power start{0.0, 0.0, 0.0, 0.2, 0.2, 0.2};
  const Fit fit = identify(without_runout(setup), start, runs, {});
  ASSERT_TRUE(fit.ok) << fit.message;
  ASSERT_EQ(fit.exponents.size(), 3U);
  EXPECT_NEAR(fit.exponents[0]->value, 0.25, 1e-6);
  EXPECT_NEAR(fit.exponents[1]->value, 0.35, 1e-6);
  EXPECT_NEAR(fit.exponents[2]->value, 0.3, 1e-6);
  EXPECT_NEAR(fit.coefficients[0]->value, 1500e6, 1e4);
  Options given;
  given.fit_exponents = false;
  const Fit fixed = identify(without_runout(setup), law, runs, given);
  EXPECT_TRUE(fixed.exponents.empty());
  EXPECT_NEAR(fixed.coefficients[1]->value, 700e6, 1e3);
}

TEST(JointFit, FeedModelFindsTheOffsetTooLarge) {
  // A sine fitted to a constant: about 4/pi of the true offset.
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  const std::vector<Record> runs = {made_record(setup, steel(), {})};
  Options options;
  options.chip_model = chip::Model::feed;
  options.phase = 0.0;
  const Fit fit = identify(without_runout(setup), steel(), runs, options);
  EXPECT_NEAR(fit.runout.radial_offsets[1], -8e-6 * 4.0 / pi, 0.2e-6);
}

TEST(JointFit, GivenPhaseIsKept) {
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  Sampling sampling;
  sampling.phase = 2.0;  // outside of the gauge of a free fit
  const std::vector<Record> runs = {made_record(setup, steel(), sampling)};
  Options options;
  options.phase = 2.0;
  const Fit fit = identify(without_runout(setup), steel(), runs, options);
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_EQ(fit.phase[0], 2.0);
  EXPECT_NEAR(fit.runout.radial_offsets[1], -8e-6, 1e-11);
}

}  // namespace trochoid::identification::joint_fit_test
