#include <trochoid/run/commands.h>

#include "made_record_file.h"

#include <gtest/gtest.h>
#include <trochoid/base/error.h>

#include <algorithm>

namespace trochoid::run::identify_test {

using namespace test;
using cases::Command;
using results::IdentifyResult;

const std::string options = R"([identify]
chip_models = ["trochoidal"]
)";
const std::string automatic = "[dynamometer]\naxes = \"auto\"\n";

IdentifyResult identified(const identification::Record& record,
                          const std::string& text) {
  const CaseFolder folder;
  folder.write("record.csv", csv_text(record, Axis::angle));
  return identify(
      folder.read(cases::test::slot + measurement + text, Command::identify),
      [](const std::string&) {});
}

bool warned(const IdentifyResult& r, const std::string& code) {
  return std::any_of(r.heading.warnings.begin(), r.heading.warnings.end(),
                     [&](const base::Warning& w) { return w.code == code; });
}

TEST(Identify, FindsWhatTheRecordWasMadeWith) {
  const IdentifyResult r = identified(two_turns(0.3, 2.0), options);
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  EXPECT_TRUE(r.reasons_against.empty());
  const identification::Fit& fit = r.fits.at(*r.chosen);
  EXPECT_NEAR(fit.coefficients[0]->value, 2620e6, 4 * fit.coefficients[0]->se);
  EXPECT_NEAR(fit.runout.radial_offsets.at(1), -8e-6, 0.5e-6);
  EXPECT_NEAR(fit.phase.at(0), 0.3, 0.01);
  ASSERT_EQ(r.records.size(), 1U);
  EXPECT_EQ(r.records[0].samples, 360U);
  EXPECT_FALSE(r.axes.has_value());
  EXPECT_EQ(r.folded.size(), 1U);
  ASSERT_TRUE(r.curve.has_value());
}

/// Left in, they pass for cutting forces.
TEST(Identify, FitsOffsetsThatNoAirTells) {
  auto record = identification::made_record(
      made_setup(), made_law(),
      {.phase = 0.3, .per_turn = 180, .turns = 10.0, .noise = 2.0});
  for (auto& F : record.force) {
    F[0] += 60.0;
    F[1] -= 90.0;
  }
  const IdentifyResult r = identified(record, options);
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  const identification::Fit& fit = r.fits.at(*r.chosen);
  ASSERT_EQ(fit.channel_offsets.size(), 1U);
  EXPECT_NEAR(fit.channel_offsets[0][0].constant, 60.0, 5.0);
  EXPECT_NEAR(fit.coefficients[0]->value, 2620e6, 4 * fit.coefficients[0]->se);
  EXPECT_NEAR(fit.coefficients[1]->value, 1560e6, 4 * fit.coefficients[1]->se);
  const IdentifyResult left_in =
      identified(record, options + "channel_offsets = \"none\"\n");
  EXPECT_TRUE(left_in.fits.at(*left_in.chosen).channel_offsets.empty());
}

TEST(Identify, WithoutTimeFitsTheModelThatDecidesAlone) {
  const CaseFolder folder;
  folder.write("record.csv", csv_text(two_turns(0.3, 2.0), Axis::angle));
  const auto given = folder.read(
      cases::test::slot + measurement + "[identify]\nsweep_um = [-10, 10, 3]\n",
      Command::identify);
  const IdentifyResult r = identify(
      given, [](const std::string&) {}, base::Stop{base::Stop::Clock::now()});
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  ASSERT_EQ(r.fits.size(), 3U);
  ASSERT_EQ(r.chosen, 2U);  // trochoidal
  EXPECT_NEAR(r.fits[2].coefficients.at(0)->value, 2620e6,
              4 * r.fits[2].coefficients.at(0)->se);
  EXPECT_EQ(r.fits[0].message, "not fitted: the time was up");
  EXPECT_FALSE(r.fits[0].coefficients.at(0).has_value());
  EXPECT_FALSE(r.sweep.has_value());
  EXPECT_FALSE(r.runout_form.has_value());
  const auto said = std::ranges::find(r.heading.warnings, "time_limit",
                                      [](const base::Warning& w) { return w.code; });
  ASSERT_NE(said, r.heading.warnings.end());
  EXPECT_TRUE(said->message.starts_with(
      "The time was up, left out: the search for another form of the runout; chip model "
      "none; chip model feed; sweep_um"))
      << said->message;
}

TEST(Identify, WithoutWorkLeftFitsTheModelThatDecidesAlone) {
  const CaseFolder folder;
  folder.write("record.csv", csv_text(two_turns(0.3, 2.0), Axis::angle));
  const auto given = folder.read(cases::test::slot + measurement, Command::identify);
  base::Stop little;
  little.left = std::make_shared<std::atomic<std::int64_t>>(1);
  little.grace = 1'000'000'000;
  const IdentifyResult r = identify(
      given, [](const std::string&) {}, little);
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  EXPECT_NEAR(r.fits[2].coefficients.at(0)->value, 2620e6,
              4 * r.fits[2].coefficients.at(0)->se);
  EXPECT_EQ(r.fits[0].message, "not fitted: these records take much work");
  EXPECT_TRUE(warned(r, "work_limit"));
  EXPECT_FALSE(warned(r, "time_limit"));
  EXPECT_LT(little.left->load(), -1000);
}

TEST(Identify, EndsEvenTheFitThatDecidesWhereItTakesTooMuch) {
  const CaseFolder folder;
  folder.write("record.csv", csv_text(two_turns(0.3, 2.0), Axis::angle));
  const auto given = folder.read(cases::test::slot + measurement, Command::identify);
  const auto work = [&](std::int64_t grace) {
    base::Stop little;
    little.left = std::make_shared<std::atomic<std::int64_t>>(1);
    little.grace = grace;
    const IdentifyResult r = identify(
        given, [](const std::string&) {}, little);
    EXPECT_TRUE(warned(r, "work_limit") || !r.heading.ok);
    return -little.left->load();
  };
  EXPECT_LT(work(0), work(1'000'000'000) / 2);
}

/// The same eccentricity before and after half a turn in the holder: all of it is the
/// tool's.
TEST(Identify, TellsToolAndHolderApart) {
  force::Setup setup = made_setup();
  setup.cutter.pitch = geometry::equal_pitch(3);
  setup.runout = {{}, 9 * unit::um, 40 * unit::deg};
  const auto record = identification::made_record(
      setup, made_law(), {.per_turn = 90, .turns = 2.0, .noise = 2.0});
  const CaseFolder folder;
  folder.write("record.csv", csv_text(record, Axis::angle));
  const auto answer = [&](const std::string& phase) {
    const std::string text = cases::test::slot + measurement + options;
    return identify(
        folder.read(
            std::string(text).replace(text.find("teeth = 2"), 9, "teeth = 3") +
                "runout = \"eccentricity\"\n" + phase +
                "previous_clamping = { eccentricity_mm = 0.009, angle_deg = 40, "
                "turned_deg = 180 }\n",
            Command::identify),
        [](const std::string&) {});
  };
  const IdentifyResult r = answer("phase_deg = 0\n");
  ASSERT_TRUE(r.clocking && r.clocking->separation) << r.heading.message;
  const auto& parts = *r.clocking->separation;
  EXPECT_NEAR(parts.tool.amount(), 9e-6, 5 * parts.tool.amount_se());
  EXPECT_LT(parts.holder.amount(), 5 * parts.holder.amount_se());
  EXPECT_EQ(r.clocking->longest_tooth,
            identification::longest_tooth(setup.cutter, setup.runout, 1 * unit::mm));
  EXPECT_FALSE(warned(r, "teeth_renumbered"));
  EXPECT_TRUE(warned(answer(""), "teeth_renumbered"));
}

TEST(Identify, SaysWhereZMayBeReversed) {
  auto record = two_turns(0.3, 2.0);
  EXPECT_FALSE(warned(identified(record, options), "axial_sign"));
  for (auto& F : record.force) F[2] = -F[2];
  const IdentifyResult r = identified(record, options);
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  EXPECT_TRUE(warned(r, "axial_sign"));
}

/// On a bull nose no reading is equal to another one, but for all signs at once.
TEST(Identify, SaysThatAnotherReadingOfTheChannelsFitsBetter) {
  force::Setup setup = made_setup();
  setup.cutter.profile = geometry::bull_nose(8 * unit::mm, 3 * unit::mm);
  const auto record = identification::made_record(
      setup, made_law(), {.phase = 0.3, .per_turn = 90, .turns = 2.0, .noise = 2.0});
  const CaseFolder folder;
  const auto answer = [&](const char* axes) {
    folder.write("record.csv", csv_text(record, Axis::angle));
    const std::string text = cases::test::tool +
                             "shape = \"bull_nose\"\ncorner_radius_mm = 3.0\n" +
                             cases::test::cut + cases::test::force;
    return identify(folder.read(text + measurement + options +
                                    "[dynamometer]\naxes = " + axes + "\n",
                                Command::identify),
                    [](const std::string&) {});
  };
  EXPECT_FALSE(warned(answer("[\"x\", \"y\", \"z\"]"), "axes_fit_better"));
  const IdentifyResult reversed = answer("[\"x\", \"y\", \"-z\"]");
  EXPECT_TRUE(warned(reversed, "axes_fit_better") || warned(reversed, "likely_cause"));
}

TEST(Identify, FindsTheAxesToo) {
  auto record = two_turns(0.3, 2.0);
  for (auto& F : record.force) {
    F = {F[1], -F[0], F[2]};
  }
  const IdentifyResult r = identified(record, automatic + options);
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  ASSERT_TRUE(r.axes.has_value());
  EXPECT_EQ(signal::axes_names(r.channels),
            (std::array<std::string, 3>{"y", "-x", "z"}));
}

/// The two channels of a record, y and -x, and what the third would have told.
TEST(Identify, GoesWithoutAChannel) {
  auto record = two_turns(0.3, 2.0);
  for (auto& F : record.force) {
    F = {F[1], -F[0], 123.0};
  }
  const CaseFolder folder;
  folder.write("record.csv", csv_text(record, Axis::angle));
  const auto answer = [&](const std::string& dynamometer) {
    return identify(folder.read(cases::test::slot + measurement +
                                    "columns = [\"Fx_N\", \"Fy_N\"]\n" + options +
                                    "[dynamometer]\n" + dynamometer,
                                Command::identify),
                    [](const std::string&) {});
  };
  const IdentifyResult r = answer("axes = [\"y\", \"-x\", \"z\"]\n");
  ASSERT_TRUE(r.heading.ok) << r.heading.message;
  EXPECT_TRUE(r.reasons_against.empty());
  const identification::Fit& fit = r.fits.at(*r.chosen);
  EXPECT_NEAR(fit.coefficients[0]->value, 2620e6, 4 * fit.coefficients[0]->se);
  EXPECT_FALSE(fit.coefficients[2]);
  EXPECT_EQ(r.runs.at(0).measured, (std::array{true, true, false}));
  for (const std::string wrong :
       {"axes = \"auto\"\n", "matrix = [[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]\n"}) {
    try {
      answer(wrong);
      ADD_FAILURE() << wrong;
    } catch (const base::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("not all three channels"),
                std::string::npos)
          << error.what();
    }
  }
}

/// The exact model answers; the others are told beside it.
TEST(Identify, ChoosesTheExactModel) {
  const IdentifyResult r = identified(
      two_turns(0.3, 2.0), "[identify]\nchip_models = [\"trochoidal\", \"none\"]\n");
  ASSERT_EQ(r.fits.size(), 2U);
  EXPECT_EQ(r.chosen, 0U);
  const IdentifyResult best = identified(
      two_turns(0.3, 2.0), "[identify]\nchip_models = [\"none\", \"feed\"]\n");
  EXPECT_EQ(best.chosen, 1U);
}

/// A reaction read as the force: refused for use, with the cure first.
TEST(Identify, SaysWhatIsLikelyWrongWithTheAxes) {
  auto record = two_turns(0.3, 2.0);
  for (auto& F : record.force) {
    F = {F[2], F[0], F[1]};
  }
  const IdentifyResult r = identified(record, options);
  ASSERT_TRUE(warned(r, "likely_cause")) << r.heading.message;
  const auto& warnings = r.heading.warnings;
  const auto cause =
      std::find_if(warnings.begin(), warnings.end(),
                   [](const base::Warning& w) { return w.code == "likely_cause"; });
  EXPECT_NE(cause->message.find("read z, x, y"), std::string::npos) << cause->message;
}

TEST(Identify, SweepsTheOffset) {
  const IdentifyResult r =
      identified(two_turns(0.3, 2.0), options + "sweep_um = [-20, 0, 5]\n");
  ASSERT_TRUE(r.sweep.has_value());
  ASSERT_EQ(r.sweep->offset.size(), 5U);
  ASSERT_EQ(r.sweep->curves.size(), 1U);
  const auto& rms = r.sweep->curves[0].rms;
  EXPECT_EQ(std::min_element(rms.begin(), rms.end()) - rms.begin(), 2)
      << "-10 um is nearest to -8";
}

}  // namespace trochoid::run::identify_test
