#include "made_record.h"

#include <gtest/gtest.h>
#include <trochoid/identification/find_axes.h>
#include <trochoid/identification/prepare.h>
#include <trochoid/identification/runout_starts.h>
#include <trochoid/identification/scan.h>

#include <cmath>

namespace trochoid::identification::missing_channel_test {

constexpr signal::Matrix3 as_it_is = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

force::Setup uneven() {
  force::Setup setup = slot_setup(3, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, 9.0 * unit::um, -6.0 * unit::um};
  return setup;
}

/// What no fit may look at stands where the force was not measured.
Record without(Record run, std::size_t axis) {
  run.measured[axis] = false;
  for (auto& F : run.force) F[axis] = 777.0;
  return run;
}

Options searching(Errors errors) {
  Options out;
  out.phase = 0.0;
  out.errors = errors;
  return out;
}

/// On a cylinder z says nothing of K_t and K_r but through the runout, which is fixed here.
TEST(MissingChannel, LeavesTheFitOfTheOthersAsItIs) {  // [I-1] [I-3]
  const force::Setup setup = uneven();
  Record run = made_record(setup, steel(), {.per_turn = 120, .turns = 8, .noise = 5});
  const Record two = without(run, 2);
  for (const Errors errors : {Errors::white, Errors::automatic}) {
    Options fixed = searching(errors);
    fixed.runout = RunoutUnknowns::fixed;
    const Fit all = identify(setup, steel(), {&run, 1}, fixed);
    const Fit fit = identify(setup, steel(), {&two, 1}, fixed);
    ASSERT_TRUE(fit.ok) << fit.message;
    for (const std::size_t c : {0U, 1U, 3U, 4U}) {
      const double K = all.coefficients[c]->value;
      EXPECT_NEAR(fit.coefficients[c]->value, K, 1e-8 * std::abs(K)) << c;
    }
    EXPECT_DOUBLE_EQ(fit.rms_axis[0], all.rms_axis[0]);
    EXPECT_DOUBLE_EQ(fit.rms_axis[2], 0.0);
    EXPECT_EQ(fit.rank, 4);
    EXPECT_EQ(fit.measured, (std::array{true, true, false}));
  }
}

TEST(MissingChannel, TellsWhatItCannot) {  // [I-3] [I-6]
  const force::Setup setup = uneven();
  const Record run = without(
      made_record(setup, steel(), {.per_turn = 120, .turns = 8, .noise = 5}), 2);
  for (const Errors errors : {Errors::white, Errors::automatic}) {
    const Fit fit =
        identify(without_runout(setup), steel(), {&run, 1}, searching(errors));
    ASSERT_TRUE(fit.ok) << fit.message;
    const std::vector<double> K = force::coefficients(steel());
    for (const std::size_t c : {0U, 1U, 3U, 4U}) {
      ASSERT_TRUE(fit.coefficients[c]) << c;
      EXPECT_NEAR(fit.coefficients[c]->value, K[c], 5 * fit.coefficients[c]->se) << c;
      EXPECT_GT(fit.coefficients[c]->se, 0.0) << c;
    }
    for (const std::size_t c : {2U, 5U}) EXPECT_FALSE(fit.coefficients[c]) << c;
    EXPECT_TRUE(refused(fit, "K_ac_MPa"));
    EXPECT_EQ(fit.unidentifiable.front().second, "the axial force was not measured");
    EXPECT_NEAR(fit.runout.radial_offsets[1], 9e-6, 0.3e-6);
    // Two equations a sample, less four coefficients and two offsets.
    EXPECT_DOUBLE_EQ(fit.freedom, 2.0 * 8 * 120 - 6);
  }
}

TEST(MissingChannel, DoesNotCountInABandNorAsADrift) {  // [I-7] [S-5]
  const force::Setup setup = uneven();
  Record run = made_record(setup, steel(), {.per_turn = 120, .turns = 8, .noise = 2});
  for (auto& F : run.force) F[0] += 20.0;
  const Record two = without(run, 2);
  for (const int band : {0, 6}) {
    Options options = searching(Errors::automatic);
    options.fit_channel_offsets = true;
    options.band_harmonics = band;
    const Fit fit = identify(without_runout(setup), steel(), {&two, 1}, options);
    ASSERT_TRUE(fit.ok) << fit.message;
    EXPECT_NEAR(fit.channel_offsets[0][0].constant, 20.0,
                0.02 * 20.0 + (band > 0 ? 20.0 : 0.0));
    EXPECT_DOUBLE_EQ(fit.channel_offsets[0][2].constant, 0.0);
    EXPECT_TRUE(refused(fit, "offset of channel 3 in run 1"));
    EXPECT_NEAR(fit.runout.radial_offsets[2], -6e-6, 0.3e-6);
    // Of each channel: samples, or 13 waves and one row of the slope; less 4
    // coefficients, 2 offsets of teeth, 2 constants, 2 slopes.
    EXPECT_DOUBLE_EQ(fit.freedom, 2.0 * (band > 0 ? 13 + 1 : 8 * 120) - 10);
  }
}

TEST(MissingChannel, IsNoLossWhereAnotherRunHasIt) {
  const force::Setup setup = uneven();
  force::Setup fast = setup;
  fast.cut.f_z *= 2.0;
  const std::vector<Record> runs = {
      without(made_record(setup, steel(), {.turns = 2, .noise = 2}), 2),
      made_record(fast, steel(), {.turns = 2, .noise = 2, .seed = 2})};
  const Fit fit =
      identify(without_runout(setup), steel(), runs, searching(Errors::white));
  ASSERT_TRUE(fit.ok) << fit.message;
  ASSERT_TRUE(fit.coefficients[2]);
  EXPECT_NEAR(fit.coefficients[2]->value, 330e6, 5 * fit.coefficients[2]->se);
  EXPECT_DOUBLE_EQ(fit.freedom, 5.0 * 2 * 360 - 8);
}

TEST(MissingChannel, OfABallEndIsFoundFromTheOthers) {
  force::Setup setup = slot_setup(2, 30.0, 1.0 * unit::mm);
  setup.cutter.profile = geometry::ball(8.0 * unit::mm);
  const Record run =
      without(made_record(setup, steel(), {.turns = 2, .noise = 0.5}), 2);
  Options options = searching(Errors::white);
  options.runout = RunoutUnknowns::none;
  const Fit fit = identify(setup, steel(), {&run, 1}, options);
  ASSERT_TRUE(fit.ok) << fit.message;
  ASSERT_TRUE(fit.coefficients[2]) << "the edge of a ball pushes sideways, too";
  EXPECT_NEAR(fit.coefficients[2]->value, 330e6, 5 * fit.coefficients[2]->se);
}

/// K_a could make up for z at a wrong phase, were z compared with anything.
TEST(MissingChannel, IsNotScanned) {  // [I-12]
  const force::Setup setup = uneven();
  const Record run =
      without(made_record(setup, steel(), {.phase = 0.7, .per_turn = 120}), 1);
  Options options = searching(Errors::white);
  options.runout = RunoutUnknowns::fixed;
  options.phase.reset();
  const Prepared prepared = prepare(setup, steel(), {&run, 1}, options);
  ASSERT_TRUE(prepared.problem) << prepared.refusal;
  const auto found = scan(*prepared.problem, runout_starts(*prepared.problem));
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found.front().p.at(0), 0.7, 0.02);
  double squares = 0.0;
  for (const auto& F : run.force) squares += F[0] * F[0] + F[2] * F[2];
  EXPECT_LT(found.front().rss, 1e-3 * squares);
}

TEST(MissingChannel, GoesWhereTheAxesSay) {
  const signal::Matrix3 turned = {{{0, 0, -1}, {1, 0, 0}, {0, 1, 0}}};
  EXPECT_EQ(measured_forces({false, true, true}, turned),
            (std::array{true, true, false}));
  const signal::Matrix3 full = {{{1, 0.1, 0}, {0, 1, 0}, {0, 0, 1}}};
  EXPECT_FALSE(measured_forces({true, true, false}, full));
  EXPECT_EQ(measured_forces({true, true, true}, full), (std::array{true, true, true}));
  const ChannelRun run{.angle = {0.0, 1.0},
                       .channel = {{{1, 2}, {3, 4}, {0, 0}}},
                       .measured = {true, true, false}};
  EXPECT_EQ(on_tool({&run, 1}, as_it_is).front().measured,
            (std::array{true, true, false}));
  EXPECT_THROW(on_tool({&run, 1}, full), std::invalid_argument);
  const AxesChoice choice = find_axes({uneven(), steel(), {}}, {&run, 1}, {});
  EXPECT_FALSE(choice.ok);
  EXPECT_NE(choice.message.find("give the axes"), std::string::npos);
}

}  // namespace trochoid::identification::missing_channel_test
