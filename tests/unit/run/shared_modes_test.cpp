#include "../cases/case_text.h"
#include "../files/uff58_made.h"
#include "../structure/made_shapes.h"

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/run/problems.h>
#include <trochoid/run/shared_modes.h>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace trochoid::run::shared_modes_test {

using cases::Command;
using cases::test::CaseFolder;

const made::Plane tilted{{{{1000, 0.03, 0.5, 30}, {1080, 0.025, 0.8, 120}}}};
const made::Measuring coarse{.band = {600, 1600, 5}};

/// One response as a table, in a unit of displacement.
std::string table(const std::string& name, const std::string& unit, double factor) {
  const auto one = made::measured(tilted, name, coarse);
  std::string text = unit.empty() ? "freq_Hz,re,im\n"
                                  : fmt::format("freq_Hz,re_{},im_{}\n", unit, unit);
  for (std::size_t i = 0; i < one.response.omega.size(); ++i) {
    text += fmt::format("{},{},{}\n", one.response.omega[i] / unit::Hz,
                        one.response.H[i].real() * factor,
                        one.response.H[i].imag() * factor);
  }
  return text;
}

const std::string three =
    "[frf]\nmodes = 2\nshapes = \"real\"\nresidual_terms = \"no\"\n"
    "[[measured_frf]]\nfile = \"xx.csv\"\naxis = \"x\"\n"
    "[[measured_frf]]\nfile = \"yy.csv\"\naxis = \"y\"\n"
    "[[measured_frf]]\nfile = \"xy.csv\"\naxis = \"x\"\nforce_axis = \"y\"\n";

void expect_tilted(const dynamics::System& system) {
  ASSERT_EQ(system.modes.size(), 2U);
  for (std::size_t r = 0; r < 2; ++r) {
    const made::TiltedMode& truth = tilted.modes[r];
    const dynamics::ChipMode& found = system.modes[r];
    EXPECT_NEAR(found.mass, truth.mass, 0.02 * truth.mass);
    EXPECT_NEAR(std::sqrt(found.stiffness / found.mass), truth.frequency * unit::Hz,
                0.001 * truth.frequency * unit::Hz);
    // A direction is a line: the product tells on which side of the axes.
    const double angle = truth.angle * unit::deg;
    EXPECT_NEAR(found.x * found.y, std::cos(angle) * std::sin(angle), 0.01);
    EXPECT_NEAR(found.x * found.x, std::cos(angle) * std::cos(angle), 0.01);
  }
}

dynamics::System included(const CaseFolder& folder, const results::ModesResult& found) {
  const results::Answer answer = results::answer_of(found);
  folder.write("modes.toml", answer.texts.at(0).text);
  const auto path =
      folder.write("use.toml", "include = \"modes.toml\"\n" +
                                   std::string("[tool]\nteeth = 2\n"
                                               "diameter_mm = 10\nhelix_deg = 0\n"
                                               "[cut]\nengagement = \"slot\"\n"
                                               "axial_depth_mm = 0.3\n"
                                               "feed_per_tooth_mm = 0.05\n"
                                               "spindle_rpm = 12000\n"
                                               "[force]\nK_tc_MPa = 600\n"
                                               "K_rc_MPa = 200\nK_ac_MPa = 0\n"
                                               "K_te_N_per_mm = 0\n"
                                               "K_re_N_per_mm = 0\n"
                                               "K_ae_N_per_mm = 0\n"));
  return chip_modes(cases::read_case(path, Command::stability).machine.modes);
}

TEST(SharedModes, GoIntoACaseOfStabilityAsTheyLie) {  // [M-33]
  const CaseFolder folder;
  folder.write("xx.csv", table("xx", "um/N", 1e6));
  folder.write("yy.csv", table("yy", "mm/N", 1e3));
  folder.write("xy.csv", table("xy", "m/N", 1));
  const auto given = cases::read_case(folder.write("case.toml", three), Command::modes);
  EXPECT_TRUE(modes_are_shared(given));
  const auto found = shared_modes(given);
  ASSERT_TRUE(found.heading.ok) << found.heading.message;
  EXPECT_TRUE(found.heading.message.starts_with("2 modes: ")) << found.heading.message;
  EXPECT_TRUE(found.heading.message.ends_with(", of the worst of 3 responses."))
      << found.heading.message;
  EXPECT_NE(found.heading.message.find(", with real shapes. "), std::string::npos);
  expect_tilted(included(folder, found));
}

TEST(SharedModes, AResponseWithoutAUnitIsRefusedWithASentence) {
  const CaseFolder folder;
  folder.write("xx.csv", table("xx", "um/N", 1e6));
  folder.write("yy.csv", table("yy", "", 1));
  folder.write("xy.csv", table("xy", "m/N", 1));
  const auto given = cases::read_case(folder.write("case.toml", three), Command::modes);
  try {
    shared_modes(given);
    FAIL() << "taken";
  } catch (const base::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the file says no unit"),
              std::string::npos)
        << error.what();
  }
}

/// A universal file of x and y: the force along x is told as one along -x.
std::string universal(const std::vector<std::string>& names, int node_of_last = 7) {
  std::string text;
  for (const std::string& name : names) {
    const auto one = made::measured(tilted, name, coarse);
    files::MadeSet set{.unit = "m", .kind = 8};
    set.direction = name[0] == 'x' ? 1 : 2;
    set.reference = name[1] == 'x' ? -1 : 2;
    set.node = &name == &names.back() ? node_of_last : 7;
    for (std::size_t i = 0; i < one.response.omega.size(); ++i) {
      set.x.push_back(one.response.omega[i] / unit::Hz);
      set.y.push_back(name[1] == 'x' ? -one.response.H[i] : one.response.H[i]);
    }
    text += files::as_text(set);
  }
  return text;
}

cases::Case bare(const CaseFolder& folder, const std::string& text) {
  cases::MachineTables machine;
  machine.frf = cases::FrfTables{
      .source = {.file = files::file_at(folder.write("all.uff", text).string())},
      .modes = 2,
      .residual_terms = cases::ResidualTerms::no,
      .shapes = cases::Shapes::real};
  return cases::bare_case(machine, Command::modes, {});
}

TEST(SharedModes, SetsOfOneUniversalFileAreTakenTogetherWithTheirSigns) {
  const CaseFolder folder;
  const auto given = bare(folder, universal({"xx", "yx", "xy", "yy"}));
  ASSERT_TRUE(modes_are_shared(given));
  const auto found = shared_modes(given);
  ASSERT_TRUE(found.heading.ok) << found.heading.message;
  ASSERT_EQ(found.responses.size(), 4U);
  EXPECT_EQ(found.responses[1].name, "yx");
  expect_tilted(included(folder, found));
  EXPECT_NEAR(found.fit.reciprocity.at(0).gain.value, 1.0, 0.01);
}

TEST(SharedModes, SetsOfSeveralPointsAreNot) {
  const CaseFolder folder;
  EXPECT_FALSE(modes_are_shared(bare(folder, universal({"xx", "xy", "yy"}, 8))));
  EXPECT_FALSE(modes_are_shared(bare(folder, universal({"xx", "yy"}))));
  EXPECT_FALSE(modes_are_shared(bare(folder, universal({"xx"}))));
}

TEST(SharedModes, AWrongCalibrationOfOneCrossResponseIsSaid) {  // [M-34]
  const CaseFolder folder;
  folder.write("xx.csv", table("xx", "m/N", 1));
  folder.write("yy.csv", table("yy", "m/N", 1));
  folder.write("xy.csv", table("xy", "m/N", 1));
  folder.write("yx.csv", table("yx", "m/N", 1.1));
  const auto found = shared_modes(cases::read_case(
      folder.write("case.toml", three + "[[measured_frf]]\nfile = \"yx.csv\"\n"
                                        "axis = \"y\"\nforce_axis = \"x\"\n"),
      Command::modes));
  ASSERT_TRUE(found.heading.ok) << found.heading.message;
  EXPECT_TRUE(
      std::any_of(found.heading.warnings.begin(), found.heading.warnings.end(),
                  [](const base::Warning& w) { return w.code == "reciprocity_hurt"; }));
}

}  // namespace trochoid::run::shared_modes_test
