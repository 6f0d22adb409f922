#include <trochoid/identification/find_axes.h>

#include "made_record.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

namespace trochoid::identification::find_axes_test {

using Names = std::array<std::string, 3>;

force::Setup with_runout() {
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  return setup;
}

/// A made record as channels that read Q force.
ChannelRun channels(const force::Setup& setup, const force::LinearEdge& law,
                    const signal::Matrix3& Q) {
  const Record record = made_record(setup, law, {.phase = 0.2, .noise = 2.0});
  ChannelRun out{record.cut, record.angle, {}};
  for (const auto& F : record.force) {
    for (std::size_t c = 0; c < 3; ++c) {
      out.channel[c].push_back(Q[c][0] * F[0] + Q[c][1] * F[1] + Q[c][2] * F[2]);
    }
  }
  return out;
}

AxesProblem problem(const force::Setup& setup) {
  return {without_runout(setup), force::LinearEdge{}, {}};
}

signal::Matrix3 reading(const Names& names) {
  return *signal::axes_matrix(names);
}

TEST(FindAxes, FindsEachWayThatAPersonMountsADynamometer) {
  const force::Setup setup = with_runout();
  for (const Names& names : {Names{"x", "y", "z"}, Names{"-x", "-y", "-z"},
                             Names{"y", "-x", "z"}, Names{"z", "x", "y"}}) {
    const ChannelRun run = channels(setup, steel(), reading(names));
    const AxesChoice choice = find_axes(problem(setup), {&run, 1}, {});
    ASSERT_TRUE(choice.ok) << choice.message;
    EXPECT_EQ(signal::axes_names(choice.matrix), names);
    EXPECT_TRUE(choice.signs_clear);
    EXPECT_GT(choice.next_rms, 1.5 * choice.rms);
    EXPECT_NEAR(reading_rms(problem(setup), {&run, 1}, choice.matrix), choice.rms,
                1e-6 * choice.rms);
  }
}

/// On a ball only the sign of all is free: 24 readings differ, and few need a fit.
TEST(FindAxes, TriesAllReadingsOnACutterThatIsNoCylinder) {
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.cutter.profile = geometry::ball(8.0 * unit::mm);
  const ChannelRun run = channels(setup, steel(), reading({"y", "z", "x"}));
  AxesProblem ball = problem(setup);
  ball.options = {.chip_model = chip::Model::none, .phase = 0.2};
  std::vector<double> told;
  const AxesChoice choice =
      find_axes(ball, {&run, 1}, [&](double part) { told.push_back(part); });
  EXPECT_LT(told.size(), 24U);
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_EQ(told.back(), 1.0);
  ASSERT_TRUE(choice.ok) << choice.message;
  EXPECT_EQ(signal::axes_names(choice.matrix), (Names{"y", "z", "x"}));
}

/// With no radial force nothing tells which of two readings is the true one.
TEST(FindAxes, SaysWhereSignsDecideNothing) {
  const force::Setup setup = with_runout();
  const force::LinearEdge no_radial{2600e6, 0.0, 330e6, 7e3, 0.0, 1e3};
  const ChannelRun run = channels(setup, no_radial, reading({"x", "y", "z"}));
  const AxesChoice choice = find_axes(problem(setup), {&run, 1}, {});
  ASSERT_TRUE(choice.ok) << choice.message;
  EXPECT_FALSE(choice.signs_clear);
}

/// Which reading leaves least is then chance: that of a cut is taken, and the other told.
TEST(FindAxes, PutsReadingsWithSignsOfNoCutBehindThoseOfACut) {
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.cutter.profile = geometry::ball(8.0 * unit::mm);
  const force::LinearEdge no_cut{340e6, -376e6, -1249e6, 7e3, -3e3, -1e3};
  const Record record =
      made_record(setup, no_cut, {.phase = 0.2, .turns = 4.0, .noise = 60.0});
  ChannelRun run{record.cut, record.angle, {}};
  for (const auto& F : record.force) {
    for (std::size_t c = 0; c < 3; ++c) run.channel[c].push_back(F[c]);
  }
  AxesProblem ball = problem(setup);
  ball.options = {.chip_model = chip::Model::none, .phase = 0.2};
  const AxesChoice choice = find_axes(ball, {&run, 1}, {});
  ASSERT_TRUE(choice.ok) << choice.message;
  ASSERT_TRUE(choice.passed_over);
  EXPECT_LT(choice.passed_over->K[1], 0.0);
  EXPECT_LT(choice.passed_over->rms, choice.rms);
  EXPECT_LT(choice.rms, 1.5 * choice.passed_over->rms);
  EXPECT_NE(choice.passed_over->matrix, choice.matrix);
}

/// As where no reading converges: there is nothing to choose from, and that is said.
TEST(FindAxes, RefusesWhereNoReadingConverges) {
  const force::Setup setup = with_runout();
  const ChannelRun run = channels(setup, steel(), reading({"x", "y", "z"}));
  AxesProblem hopeless = problem(setup);
  hopeless.options.stop.left = std::make_shared<std::atomic<std::int64_t>>(0);
  const AxesChoice choice = find_axes(hopeless, {&run, 1}, {});
  EXPECT_FALSE(choice.ok);
  EXPECT_NE(choice.message.find("did not converge"), std::string::npos)
      << choice.message;
  EXPECT_FALSE(std::isfinite(choice.rms));
}

TEST(OnTool, TurnsChannelsIntoForces) {
  const ChannelRun run{{}, {0.0}, {{{1.0}, {2.0}, {3.0}}}};
  const auto runs = on_tool({&run, 1}, reading({"-y", "x", "z"}));
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].force.at(0), (force::Vector3{2.0, -1.0, 3.0}));
  EXPECT_THROW(on_tool({&run, 1}, {}), std::invalid_argument);
}

/// Seven inserts that stand out by up to 51 um, offsets of the channels found as well: the
/// search took a minimum with edge forces that pull.
TEST(FindAxes, OfAFaceMillWithScatteredInserts) {
  force::Setup setup = slot_setup(7, 5.0, 2.0 * unit::mm);
  setup.cutter.profile = geometry::cylinder(80.0 * unit::mm);
  setup.cutter.profile.beta = 45.0 * unit::deg;
  setup.cutter.lag_diameter = 80.0 * unit::mm;
  setup.cut.engagement = geometry::Band{-30.0 * unit::mm, 30.0 * unit::mm};
  setup.cut.f_z = 200.0 * unit::um;
  setup.runout.radial_offsets = {12e-6, -20e-6, 5e-6, 31e-6, -11e-6, 3e-6, 0.0};
  const force::LinearEdge law{1650e6, 620e6, 280e6, 18e3, 22e3, 4e3};
  const Record record = made_record(
      setup, law, {.phase = -0.18, .per_turn = 375, .turns = 13, .noise = 15});
  ChannelRun run{record.cut, record.angle, {}};
  for (const auto& F : record.force) {
    for (std::size_t c = 0; c < 3; ++c) run.channel[c].push_back(-F[c]);
  }
  AxesProblem asked = problem(setup);
  asked.options.fit_channel_offsets = true;
  const AxesChoice axes = find_axes(asked, {&run, 1}, {});
  ASSERT_TRUE(axes.ok) << axes.message;
  EXPECT_EQ(signal::axes_names(axes.matrix), (Names{"-x", "-y", "-z"}));
  EXPECT_GT(axes.next_rms, 10 * axes.rms);
  EXPECT_TRUE(axes.mirrored);  // z the other way round exchanges K_rc and K_ac
}

}  // namespace trochoid::identification::find_axes_test
