#include "case_text.h"

#include <gtest/gtest.h>

namespace trochoid::cases::case_include_test {

using test::CaseFolder;

TEST(CaseInclude, TheIncludingFileWins) {
  const CaseFolder folder;
  static_cast<void>(folder.write("parts/material.toml",
                                 test::force + "[runout]\neccentricity_mm = 0.01\n"
                                               "angle_deg = 10\n"));
  const Case c = folder.read("include = \"parts/material.toml\"\n" + test::tool +
                             test::cut + "[runout]\nangle_deg = 20\n");
  EXPECT_DOUBLE_EQ(std::get<force::LinearEdge>(c.law).K_tc, 2620e6);
  EXPECT_DOUBLE_EQ(c.setup.runout.eccentricity, 1e-5);
  EXPECT_DOUBLE_EQ(c.setup.runout.angle * 180 / 3.14159265358979323846, 20);
}

TEST(CaseInclude, IsRelativeToTheFileThatIncludesAndMayNest) {
  const CaseFolder folder;
  static_cast<void>(folder.write("a/1.toml", "include = \"b/2.toml\"\n" + test::tool));
  static_cast<void>(
      folder.write("a/b/2.toml", "include = \"../../3.toml\"\n" + test::cut));
  static_cast<void>(folder.write("3.toml", "title = \"deep\"\n" + test::force));
  EXPECT_EQ(folder.read("include = \"a/1.toml\"\n").title, "deep");
}

TEST(CaseInclude, MeasurementsOfAnIncludedFileAreFoundBesideIt) {
  const CaseFolder folder;
  const auto record = folder.write("data/run.csv", "x");
  static_cast<void>(
      folder.write("data/runs.toml", "[[measurement]]\nfile = \"run.csv\"\n"));
  const Case c = folder.read("include = \"data/runs.toml\"\n" + test::tool + test::cut,
                             Command::identify);
  ASSERT_EQ(c.measurements.size(), 1U);
  EXPECT_EQ(c.measurements[0].source.file.path, record);
  EXPECT_EQ(c.measurements[0].source.file.location,
            (folder.path() / "data/runs.toml").string() + ":2:8");
}

TEST(CaseInclude, FilesSideBySideJoinTheirModes) {
  const CaseFolder folder;
  const auto modes = [](const char* axis, const char* mass) {
    return std::string("title = \"") + axis +
           "\"\n[[mode]]\nbody = \"tool\"\naxis = \"" + axis + "\"\nmass_kg = " + mass +
           "\nfrequency_Hz = 900\ndamping_ratio = 0.02\n";
  };
  static_cast<void>(folder.write("x.toml", modes("x", "0.1")));
  static_cast<void>(folder.write("y.toml", modes("y", "0.2")));
  const std::string both = "include = [\"x.toml\", \"y.toml\"]\n";
  const std::string rest = test::tool + test::cut + test::force;
  const Case c = folder.read(both + rest, Command::stability);
  ASSERT_EQ(c.machine.modes.size(), 2U);
  EXPECT_EQ(c.machine.modes[0].mass, 0.1);
  EXPECT_EQ(c.machine.modes[1].mass, 0.2);
  EXPECT_EQ(c.title, "y") << "of what is no list the later file wins";
  const Case own = folder.read(both + rest +
                                   "[[mode]]\nbody = \"tool\"\naxis = \"x\"\n"
                                   "mass_kg = 0.3\nfrequency_Hz = 900\n"
                                   "damping_ratio = 0.02\n",
                               Command::stability);
  ASSERT_EQ(own.machine.modes.size(), 1U) << "the list of the case replaces both";
  EXPECT_EQ(folder.problems("include = [\"x.toml\", 3]\n" + rest, Command::stability),
            "case.toml:1:22: include = 3: not a file name; must be text, the case file "
            "whose tables this one builds on, or a list of such files\n");
}

TEST(CaseInclude, OneFormReplacesTheOther) {
  const CaseFolder folder;
  static_cast<void>(folder.write("base.toml", R"(
[cut]
engagement = "up"
radial_depth_mm = 1.0
axial_depth_mm = 2.0
feed_rate_mm_per_min = 70
spindle_rpm = 875
[dynamometer]
axes = ["x", "y", "z"]
)" + test::tool + test::force));
  const Case c = folder.read(R"(
include = "base.toml"
[cut]
engagement = "slot"
feed_per_tooth_mm = 0.1
[dynamometer]
matrix = [[2, 0, 0], [0, 2, 0], [0, 0, 2]]
)");
  EXPECT_TRUE(std::holds_alternative<geometry::Slot>(c.setup.cut.engagement));
  EXPECT_EQ(c.setup.cut.f_z, 0.1 * 1e-3);
  EXPECT_EQ(c.dynamometer->matrix[1][1], 2.0);
}

TEST(CaseInclude, AListOfTablesIsReplacedWhole) {
  const CaseFolder folder;
  static_cast<void>(folder.write("run.csv", "x"));
  static_cast<void>(folder.write(
      "base.toml",
      "[[measurement]]\nfile = \"gone.csv\"\n[[measurement]]\nfile = \"lost.csv\"\n"));
  const Case c = folder.read("include = \"base.toml\"\n" + test::tool + test::cut +
                                 "[[measurement]]\nfile = \"run.csv\"\n",
                             Command::identify);
  EXPECT_EQ(c.measurements.size(), 1U);
}

TEST(CaseInclude, AMistakeNamesTheFileItIsIn) {
  const CaseFolder folder;
  static_cast<void>(folder.write("parts/tool.toml", "[tool]\nteeth = 0\n"));
  const std::string text =
      "include = \"parts/tool.toml\"\n[tool]\nhelix_deg = 95\n"
      "diameter_mm = 8\n" +
      test::cut + test::force;
  EXPECT_EQ(
      folder.problems(text),
      "case.toml:3:13: tool.helix_deg = 95 deg: out of range; must be a number "
      "above -90 and below 90 deg, or a list of one for each tooth (helix angle, "
      "right-hand; negative: left-hand, or negative axial rake; a list: of each tooth)\n"
      "parts/tool.toml:2:9: tool.teeth = 0: out of range; must be a whole number "
      "from 1 to 64 (number of teeth)\n");
}

TEST(CaseInclude, AFileIncludedTwiceIsNoCycle) {
  const CaseFolder folder;
  static_cast<void>(folder.write("b.toml", "include = \"d.toml\"\n"));
  static_cast<void>(folder.write("d.toml", "title = \"d\"\n"));
  EXPECT_EQ(folder.read("include = \"./b.toml\"\n" + test::slot).title, "d");
}

}  // namespace trochoid::cases::case_include_test
