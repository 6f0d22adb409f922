#include "../cases/case_text.h"
#include "slot_case.h"

#include <trochoid/run/commands.h>
#include <trochoid/run/work.h>

#include <gtest/gtest.h>

#include <variant>

/// What is estimated before a command is what the command then does, by counts.
namespace trochoid::run::work_test {

using cases::Command;
using cases::test::CaseFolder;

const std::string cut =
    small_cut("engagement = \"down\"\nradial_depth_mm = 1", "0.2", 5000) + one_mode;

cases::Case read(const std::string& more, Command command) {
  return CaseFolder().read(cut + more, command);
}

TEST(WorkOf, SimulateIsItsAngles) {
  for (const char* sampling :
       {"samples_per_rev = 90\nrevolutions = 2.5", "angles_deg = [1, 2, 3]"}) {
    const auto given = read(std::string("[sampling]\n") + sampling, Command::simulate);
    EXPECT_EQ(work_of(Command::simulate, given).at(0).count,
              static_cast<double>(simulate(given).phi.size()));
  }
}

TEST(WorkOf, TurnsThatRepeatAreComputedOnce) {
  const auto evaluations = [](const char* turns) {
    const auto given = read(std::string("[sampling]\nsamples_per_rev = 90\n") + turns,
                            Command::simulate);
    return work_of(Command::simulate, given).at(0).evaluations;
  };
  const double one = evaluations("revolutions = 1");
  EXPECT_LT(evaluations("revolutions = 2"), 1.5 * one);
  EXPECT_LT(evaluations("revolutions = 0.5"), 0.6 * one);
}

TEST(WorkOf, StabilityIsThePointsOfItsLobes) {
  const auto given =
      read("[stability]\nspindle_rpm = [9000, 12000, 4]\naxial_depth_mm = [0.1, 1, 3]",
           Command::stability);
  EXPECT_EQ(
      work_of(Command::stability, given).at(0).count,
      static_cast<double>(stability(given, {}).stability.lobes.multiplier.size()));
}

TEST(WorkOf, StabilityCountsTheVibrationsOfAPeriod) {
  const auto given = read("", Command::stability);
  EXPECT_NEAR(work_of(Command::stability, given).at(1).count, 922 * 60 / 5000.0 / 2,
              1e-9);
  const auto uneven =
      read("[runout]\nradial_offsets_mm = [0, 0.01]", Command::stability);
  EXPECT_NEAR(work_of(Command::stability, uneven).at(1).count, 922 * 60 / 5000.0, 1e-9);
}

TEST(WorkOf, DynamicsIsItsSteps) {
  const auto given = read("[sampling]\nrevolutions = 30", Command::dynamics);
  const results::MotionResult r = dynamics(given, {});
  ASSERT_TRUE(r.steady.has_value());
  ASSERT_EQ(r.steady->motion.turns_done, 30);
  EXPECT_EQ(work_of(Command::dynamics, given).at(0).count,
            30.0 * r.steps_per_tooth * 2);
}

TEST(WorkOf, StepsThatAreNotComputedAnyhowAreNoWork) {
  auto given = read("", Command::dynamics);
  given.setup.cut.Omega /= 10000;
  EXPECT_TRUE(work_of(Command::dynamics, given).empty());
}

TEST(WorkOf, SurfaceIsThePointsOfItsMap) {
  const auto given = read(
      "[cutter_body]\noverhang_mm = 40\nyoungs_modulus_GPa = 206\n"
      "[surface]\nheights_mm = [0.1, 0.2]\n[sampling]\nsamples_per_rev = 36",
      Command::surface);
  double points = 0.0;
  for (const surface::ErrorRow& row : surface(given, {}).map.rows) {
    points += static_cast<double>(row.error.size());
  }
  EXPECT_EQ(work_of(Command::surface, given).at(0).count, points);
}

TEST(WorkOf, PlanIsTheCutsItLooksAt) {
  const auto given = read("[plan]\naxial_depth_mm = [0.1, 0.2]", Command::plan);
  EXPECT_EQ(work_of(Command::plan, given).back().count,
            static_cast<double>(plan(given, {}).looked_at));
}

TEST(WorkOf, RecordsAreTheirBytes) {
  const CaseFolder folder;
  folder.write("record.csv", std::string(1234, '1'));
  const auto given =
      folder.read(cut + "[[measurement]]\nfile = \"record.csv\"", Command::identify);
  EXPECT_EQ(work_of(Command::identify, given).at(0).count, 1234);
  cases::Case bare;
  bare.machine.frf.emplace().source.file.path = (folder.path() / "record.csv").string();
  EXPECT_EQ(work_of(Command::modes, bare).at(0).count, 1234);
  bare.machine.frf->source.file.path = (folder.path() / "none.csv").string();
  EXPECT_EQ(work_of(Command::modes, bare).at(0).count, 0);
}

Work some(double evaluations, double bytes, double power = 1) {
  return {.what = "pieces",
          .count = 3,
          .evaluations = evaluations,
          .bytes = bytes,
          .key = {.name = "table.key", .value = 400, .power = power}};
}

TEST(TooMuch, IsMoreThanAGigabyteOrABillion) {
  EXPECT_EQ(too_much(std::vector<Work>{}), "");
  EXPECT_EQ(too_much(std::vector{some(1e9, 1e9)}), "");
  EXPECT_NE(too_much(std::vector{some(1.1e9, 0)}), "");
  EXPECT_NE(too_much(std::vector{some(0, 1.1e9)}), "");
  EXPECT_NE(too_much(std::vector{some(6e8, 0), some(6e8, 0)}), "");
}

TEST(TooMuch, NamesTheValueThatWouldDo) {
  EXPECT_EQ(too_much(std::vector{some(4e9, 1e6)}),
            "table.key = 400: up to 100 would do. This would take about 4e+09 "
            "evaluations, 7 min on one core, most of it for 3 pieces; more than 1e+09 "
            "evaluations or 1 GB are computed with --anyway only");
  const auto says = [](const Work& work, const char* what) {
    const std::string text = too_much(std::vector{work});
    EXPECT_NE(text.find(what), std::string::npos) << text;
  };
  says(some(0, 8e9), "= 400: up to 50 would do");
  says(some(0, 8e9), "and 8 GB of memory");
  says(some(16e9, 0, 2), "= 400: up to 100 would do");
  says(some(4e9, 0, -1), "= 400: from 1600 would do");
  says(some(4e9, 0, 0), "= 400. This would");
  says(some(3e9, 0), "= 400: up to 130 would do");
}

TEST(TooMuch, LeavesRoomForTheRest) {
  const std::string text = too_much(std::vector{some(8e8, 0), some(5e8, 0)});
  EXPECT_TRUE(text.starts_with("table.key = 400: up to 250 would do")) << text;
}

/// A value that is named is one that is then taken.
TEST(TooMuch, TakesWhatItNames) {
  auto given = read("[sampling]\nsamples_per_rev = 1000", Command::simulate);
  given.setup.cutter.profile = geometry::ball(10e-3);
  given.sampling.samples_per_rev = 50'000'000;
  const std::string text = too_much(work_of(Command::simulate, given));
  const std::string before = "= 5e+07: up to ";
  ASSERT_NE(text.find(before), std::string::npos) << text;
  const double value = std::stod(text.substr(text.find(before) + before.size()));
  given.sampling.samples_per_rev = static_cast<int>(value);
  EXPECT_EQ(too_much(work_of(Command::simulate, given)), "");
  given.sampling.samples_per_rev = static_cast<int>(1.1 * value);
  EXPECT_NE(too_much(work_of(Command::simulate, given)), "");
}

}  // namespace trochoid::run::work_test
