#include "case_text.h"

#include <gtest/gtest.h>

#include <numbers>

namespace trochoid::cases::case_measurement_test {

using test::CaseFolder;

struct CaseMeasurement : testing::Test {
  CaseFolder folder;
  void SetUp() override { static_cast<void>(folder.write("run.csv", "x")); }

  [[nodiscard]] Case read(const std::string& rest) const {
    return folder.read(test::tool + test::cut + rest, Command::identify);
  }
  [[nodiscard]] std::string problems(const std::string& rest) const {
    return folder.problems(test::tool + test::cut + rest, Command::identify);
  }
};

TEST_F(CaseMeasurement, EachRunMayOverrideTheCut) {
  const Case c = read(R"(
[[measurement]]
file = "run.csv"
[[measurement]]
file = "run.csv"
cut = { feed_rate_mm_per_min = 140, engagement = "down", radial_depth_mm = 2 }
[[measurement]]
file = "run.csv"
cut.spindle_rpm = 1750
)");
  ASSERT_EQ(c.measurements.size(), 3U);
  EXPECT_EQ(c.measurements[0].cut.f_z, c.setup.cut.f_z);
  EXPECT_NEAR(c.measurements[1].cut.f_z, 8e-5, 1e-18);
  EXPECT_DOUBLE_EQ(
      std::get<geometry::DownMilling>(c.measurements[1].cut.engagement).a_e, 2e-3);
  EXPECT_EQ(c.measurements[1].cut.a_p, c.setup.cut.a_p);
  EXPECT_DOUBLE_EQ(c.measurements[2].cut.Omega, 1750 * std::numbers::pi / 30);
}

TEST_F(CaseMeasurement, AMistakeInTheCutIsToldOnce) {
  const std::string text =
      "[tool]\nteeth = 2\ndiameter_mm = 8\nhelix_deg = 30\n"
      "[cut]\nengagement = \"slot\"\naxial_depth_mm = -2\n"
      "feed_per_tooth_mm = 0.04\n"
      "[[measurement]]\nfile = \"run.csv\"\n"
      "cut = { feed_per_tooth_mm = 0.05 }\n";
  EXPECT_EQ(
      folder.problems(text, Command::identify),
      "case.toml:5:1: cut.spindle_rpm is missing; must be a number above 0 and at "
      "most 1e+06 rpm (spindle speed)\n"
      "case.toml:7:18: cut.axial_depth_mm = -2 mm: out of range; must be a number "
      "above 0 and at most 10000 mm (axial depth of cut)\n");
}

TEST_F(CaseMeasurement, OverriddenFeedsMustAgree) {
  EXPECT_EQ(
      problems("[[measurement]]\nfile = \"run.csv\"\n"
               "cut = { feed_per_tooth_mm = 0.05, feed_rate_mm_per_min = 70 }\n"),
      "case.toml:12:58: measurement[1].cut.feed_rate_mm_per_min = 70 mm/min: with 2 "
      "teeth at 875 rpm this is 0.04 mm per tooth, but feed_per_tooth_mm = 0.05; "
      "give one of them, or 87.5 mm/min\n");
}

TEST_F(CaseMeasurement, AxesBecomeAMatrix) {
  const std::string run = "[[measurement]]\nfile = \"run.csv\"\n";
  const auto d =
      read(run + "[dynamometer]\naxes = [\"-y\", \"x\", \"+z\"]\n").dynamometer;
  EXPECT_FALSE(d->automatic);
  EXPECT_EQ(d->matrix,
            (std::array<std::array<double, 3>, 3>{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}));
  EXPECT_TRUE(read(run + "[dynamometer]\naxes = \"auto\"\n").dynamometer->automatic);
}

TEST_F(CaseMeasurement, ColumnsMayLeaveChannelsOut) {
  const std::string run = "[[measurement]]\nfile = \"run.csv\"\ncolumns = ";
  const auto columns = [&](const std::string& list) {
    return read(run + list).measurements.at(0).source.columns;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(columns("[\"a\", \"b\"]\n"), (Names{"a", "b", ""}));
  EXPECT_EQ(columns("[\"a\", \"\", \"c\"]\n"), (Names{"a", "", "c"}));
  EXPECT_EQ(columns("[\"a\"]\n"), (Names{"a", "", ""}));
  EXPECT_NE(problems(run + "[\"\", \"\"]\n").find("no entry names a column"),
            std::string::npos);
  EXPECT_NE(problems(run + "[\"a\", \"b\", \"c\", \"d\"]\n")
                .find("4 entries for 3 channels; must be one for each"),
            std::string::npos);
}

TEST_F(CaseMeasurement, IdentifyTakesEveryOption) {
  const Identify i = read(R"(
[[measurement]]
file = "run.csv"
[identify]
chip_models = ["radial"]
runout = "fixed"
phase_deg = 90
band_harmonics = 8
channel_offsets = "fit"
sweep_um = [-20, 20, 41]
)")
                         .identify;
  EXPECT_EQ(i.chip_models, std::vector{chip::Model::radial});
  EXPECT_EQ(i.runout, identification::RunoutUnknowns::fixed);
  EXPECT_DOUBLE_EQ(i.phase.value(), std::numbers::pi / 2);
  EXPECT_EQ(i.band_harmonics, 8);
  EXPECT_EQ(i.channel_offsets, ChannelOffset::fit);
  EXPECT_DOUBLE_EQ(i.sweep->first, -20e-6);
  EXPECT_DOUBLE_EQ(i.sweep->last, 20e-6);
  EXPECT_EQ(i.sweep->count, 41);
}

TEST_F(CaseMeasurement, APreviousClampingIsATableInATable) {
  const Case c = read(R"(
[[measurement]]
file = "run.csv"
[identify]
runout = "eccentricity"
previous_clamping = { eccentricity_mm = 0.012, angle_deg = 90, turned_deg = 180, angle_se_deg = 2 }
)");
  const PreviousClamping before = c.identify.previous_clamping.value();
  EXPECT_DOUBLE_EQ(before.eccentricity, 12e-6);
  EXPECT_DOUBLE_EQ(before.angle, std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(before.turned, std::numbers::pi);
  EXPECT_FALSE(before.eccentricity_se.has_value());
  EXPECT_NE(
      c.as_understood.find("previous_clamping = { eccentricity_mm = 0.012, angle_deg "
                           "= 90, turned_deg = 180, angle_se_deg = 2 }"),
      std::string::npos)
      << c.as_understood;
}

TEST_F(CaseMeasurement, CheckAsksForWhatTheCaseIsMadeFor) {
  const std::string bare = test::tool + test::cut;
  EXPECT_EQ(
      folder.problems(bare + "[[measurement]]\nfile = \"run.csv\"\n", std::nullopt),
      "");
  EXPECT_NE(folder.problems(bare, std::nullopt).find("[force] is missing"),
            std::string::npos);
}

TEST_F(CaseMeasurement, PreviousIsAllowedWithTheModelWithoutRunout) {
  EXPECT_EQ(problems("[chip]\nlookback = \"previous\"\n"
                     "[[measurement]]\nfile = \"run.csv\"\n"),
            "");
}

}  // namespace trochoid::cases::case_measurement_test
