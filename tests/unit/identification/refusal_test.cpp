#include "made_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace trochoid::identification::refusal_test {

void expect_no_numbers(const Fit& fit) {
  EXPECT_FALSE(fit.ok);
  EXPECT_FALSE(fit.message.empty());
  for (const auto& K : fit.coefficients) EXPECT_FALSE(K.has_value());
}

TEST(Refusal, ForceThatDoesNotChangeHasThreeMeansOnly) {  // [I-6]
  // The lag over a_p is the pitch of four teeth: without runout nothing ever changes.
  const force::Setup setup =
      slot_setup(4, 30.0, 8e-3 * pi / 4.0 / std::tan(30.0 * unit::deg));
  force::Setup none = setup;
  none.chip.model = chip::Model::none;
  std::vector<Record> runs = {made_record(none, steel(), {})};
  for (const chip::Model model : {chip::Model::none, chip::Model::trochoidal}) {
    for (const bool free : {true, false}) {
      Options options;
      options.chip_model = model;
      if (!free) options.phase = 0.0;
      expect_no_numbers(identify(setup, steel(), runs, options));
    }
  }
  // The same by the rank of [D], when the record does change.
  runs[0].force[10][0] += 1.0;
  Options options;
  options.chip_model = chip::Model::none;
  options.phase = 0.0;
  const Fit fit = identify(setup, steel(), runs, options);
  expect_no_numbers(fit);
  EXPECT_EQ(fit.rank, 3);
  EXPECT_NE(fit.message.find("3 of 6"), std::string::npos) << fit.message;
  EXPECT_NE(fit.message.find("K_te_N_per_mm"), std::string::npos) << fit.message;
}

TEST(Refusal, NotOfConstantForcesAtTwoFeeds) {  // [I-6]
  // Three means at each of two feeds are six equations for six coefficients.
  force::Setup slow = slot_setup(4, 30.0, 8e-3 * pi / 4.0 / std::tan(30.0 * unit::deg));
  slow.chip.model = chip::Model::none;
  force::Setup fast = slow;
  fast.cut.f_z = 70.0 * unit::um;
  const std::vector<Record> runs = {made_record(slow, steel(), {}),
                                    made_record(fast, steel(), {})};
  Options options;
  options.chip_model = chip::Model::none;
  options.phase = 0.0;
  const Fit fit = identify(slow, steel(), runs, options);
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_EQ(fit.rank, 6);
  EXPECT_NEAR(fit.coefficients[0]->value, 2600e6, 10.0);
  EXPECT_NEAR(fit.coefficients[5]->value, 1e3, 1e-3);
}

TEST(Refusal, CoefficientThatAChannelOffsetHides) {  // [I-6] [I-7]
  // Two teeth in a slot: one of them is in cut at every height, so the axial edge force
  // is constant, like an offset of the third channel. All the rest can be told.
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.chip.model = chip::Model::feed;
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  std::vector<Record> runs = {made_record(setup, steel(), {})};
  for (auto& F : runs[0].force) F[2] += 30.0;
  Options options;
  options.chip_model = chip::Model::feed;
  options.runout = RunoutUnknowns::fixed;
  options.phase = 0.0;
  options.fit_channel_offsets = true;
  const Fit fit = identify(setup, steel(), runs, options);
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_EQ(fit.rank, 11);
  EXPECT_FALSE(fit.coefficients[5].has_value());
  EXPECT_TRUE(refused(fit, "K_ae_N_per_mm"));
  const std::vector<double> K = force::coefficients(steel());
  for (std::size_t c = 0; c < 5; ++c) {
    ASSERT_TRUE(fit.coefficients[c].has_value()) << c;
    EXPECT_NEAR(fit.coefficients[c]->value, K[c], 1e-5 * K[c]) << c;
  }
  EXPECT_LT(fit.rms, 1e-5);
}

TEST(Refusal, CoefficientThatTheOffsetsOfSeveralRunsHide) {  // [I-6] [I-7]
  // The same of two runs: the axial edge force and both offsets have no value, though a
  // least-squares solution of smallest size gives them one.
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.chip.model = chip::Model::feed;
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  force::Setup faster = setup;
  faster.cut.f_z = 70.0 * unit::um;
  std::vector<Record> runs = {made_record(setup, steel(), {}),
                              made_record(faster, steel(), {})};
  for (auto& F : runs[1].force) F[2] += 30.0;
  Options options;
  options.chip_model = chip::Model::feed;
  options.runout = RunoutUnknowns::fixed;
  options.phase = 0.0;
  options.fit_channel_offsets = true;
  const Fit fit = identify(setup, steel(), runs, options);
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_FALSE(fit.coefficients[5].has_value());
  for (const std::string name : {"K_ae_N_per_mm", "offset of channel 3 in run 1",
                                 "offset of channel 3 in run 2"}) {
    EXPECT_TRUE(refused(fit, name)) << name;
  }
  EXPECT_FALSE(refused(fit, "offset of channel 1 in run 1"));
  EXPECT_FALSE(refused(fit, "drift of channel 3 in run 1"));
}

TEST(Refusal, NothingInCut) {  // [I-6]
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.cut.engagement = geometry::Band{1.0, 2.0};
  Record run = made_record(setup, steel(), {});
  run.force[0][0] = 1.0;
  Options options;
  options.phase = 0.0;
  options.runout = RunoutUnknowns::none;
  const Fit fit = identify(setup, steel(), std::vector<Record>{run}, options);
  expect_no_numbers(fit);
  EXPECT_NE(fit.message.find("nothing is in cut"), std::string::npos) << fit.message;
}

TEST(Refusal, ZeroFeed) {
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  Record run = made_record(setup, steel(), {});
  run.cut.f_z = 0.0;
  const Fit fit = identify(setup, steel(), std::vector<Record>{run}, {});
  expect_no_numbers(fit);
  EXPECT_NE(fit.message.find("zero"), std::string::npos) << fit.message;
}

TEST(Refusal, FewerEquationsThanUnknowns) {
  const force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  Record run = made_record(setup, steel(), {});
  run.angle.resize(2);
  run.force.resize(2);
  const Fit fit = identify(setup, steel(), std::vector<Record>{run}, {});
  expect_no_numbers(fit);
  EXPECT_NE(fit.message.find("6 equations for 8 unknowns"), std::string::npos)
      << fit.message;
}

TEST(Refusal, NotFinite) {
  const force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  Record run = made_record(setup, steel(), {});
  run.force[7][1] = std::numeric_limits<double>::quiet_NaN();
  expect_no_numbers(identify(setup, steel(), std::vector<Record>{run}, {}));
  run = made_record(setup, steel(), {});
  run.angle[7] = std::numeric_limits<double>::infinity();
  expect_no_numbers(identify(setup, steel(), std::vector<Record>{run}, {}));
}

TEST(Refusal, NoRunsAndWrongShapes) {
  const force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  expect_no_numbers(identify(setup, steel(), {}, {}));
  Record run = made_record(setup, steel(), {});
  run.angle.pop_back();
  EXPECT_THROW(identify(setup, steel(), std::vector<Record>{run}, {}),
               std::invalid_argument);
}

TEST(Refusal, RunoutOfASingleTooth) {
  const force::Setup setup = slot_setup(1, 30.0, 2.0 * unit::mm);
  const std::vector<Record> runs = {made_record(setup, steel(), {})};
  const Fit fit = identify(setup, steel(), runs, {});
  EXPECT_TRUE(fit.ok) << fit.message;
  EXPECT_TRUE(refused(fit, "radial_offsets_mm"));
  Options options;
  options.runout = RunoutUnknowns::eccentricity;
  const Fit other = identify(setup, steel(), runs, options);
  EXPECT_TRUE(refused(other, "eccentricity_mm"));
  EXPECT_FALSE(other.eccentricity_se.has_value());
}

TEST(Refusal, OffsetOfAToothThatNeverCuts) {
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -60.0 * unit::um};
  const std::vector<Record> runs = {made_record(setup, steel(), {})};
  const Fit fit = identify(without_runout(setup), steel(), runs, {});
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_TRUE(refused(fit, "radial_offsets_mm[2]"));
  EXPECT_FALSE(fit.radial_offsets_se[1].has_value());
  EXPECT_LT(fit.rms, 1e-5 * peak(runs[0]));
  EXPECT_NEAR(fit.coefficients[0]->value, 2600e6, 1e4);
}

TEST(Refusal, RunoutMadeOfNoise) {
  // One tooth pitch of lag and no runout: the force is constant, and any runout that is
  // found explains noise. The coefficients that come with it would be far off.
  const force::Setup setup =
      slot_setup(4, 30.0, 8e-3 * pi / 4.0 / std::tan(30.0 * unit::deg));
  Sampling noisy;
  noisy.turns = 2.0;
  for (const double noise : {1.0, 20.0, 200.0}) {
    noisy.noise = noise;
    const std::vector<Record> runs = {made_record(setup, steel(), noisy)};
    const Fit fit = identify(setup, steel(), runs, {});
    expect_no_numbers(fit);
    EXPECT_NE(fit.message.find("noise"), std::string::npos) << fit.message;
  }
}

TEST(Refusal, PhaseOfTeethThatEnterBetweenSamplesIsNotKnownBetterThanThat) {
  const force::Setup setup = slot_setup(4, 0.0, 2.0 * unit::mm);
  Sampling noisy;
  noisy.phase = 0.3;
  noisy.noise = 20.0;
  noisy.turns = 2.0;
  const std::vector<Record> runs = {made_record(setup, steel(), noisy)};
  Options options;
  options.runout = RunoutUnknowns::none;
  const Fit fit = identify(setup, steel(), runs, options);
  ASSERT_TRUE(fit.ok) << fit.message;
  ASSERT_TRUE(fit.phase_se[0].has_value());
  EXPECT_GT(*fit.phase_se[0], 0.2 * unit::deg);
  EXPECT_NEAR(fit.phase[0], 0.3, 4.0 * *fit.phase_se[0]);
}

}  // namespace trochoid::identification::refusal_test
