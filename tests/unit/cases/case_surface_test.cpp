#include "case_text.h"

#include <gtest/gtest.h>

namespace trochoid::cases::case_surface_test {

using test::CaseFolder;

const std::string tool = R"([tool]
teeth = 3
diameter_mm = 12.0
helix_deg = 45.0
[cut]
engagement = "down"
radial_depth_mm = 1.0
axial_depth_mm = 3.0
feed_per_tooth_mm = 0.2
spindle_rpm = 2000
)";
const std::string body = R"([cutter_body]
overhang_mm = 83.0
flute_length_mm = 45.0
youngs_modulus_GPa = 206
)";
const std::string wall = R"([wall]
length_mm = 60.5
height_mm = 30.0
thickness_mm = 2.0
youngs_modulus_GPa = 69
poisson_ratio = 0.33
)";
const std::string measured = "[[surface_measurement]]\nfile = \"wall.csv\"\n";

TEST(CaseSurface, IsThereWithItsDefaultsWhereItIsLeftOut) {
  const Case c = CaseFolder().read(tool + test::force, Command::surface);
  ASSERT_TRUE(c.machine.surface.has_value());
  EXPECT_EQ(c.machine.surface->model, surface::Model::envelope);
  EXPECT_EQ(c.machine.surface->load, surface::Load::distributed);
  EXPECT_EQ(c.machine.surface->feedback, std::nullopt);
  EXPECT_EQ(c.machine.surface->phase, 0.0);
  EXPECT_EQ(c.machine.surface->probe_diameter, 0.0);
  EXPECT_TRUE(c.machine.surface->heights.empty());
  EXPECT_TRUE(c.machine.surface->influence_heights.empty());
  EXPECT_NE(c.as_understood.find("[surface]\nmodel = \"envelope\"\n"),
            std::string::npos);
  EXPECT_FALSE(CaseFolder().read(tool + test::force).machine.surface.has_value());
}

TEST(CaseSurface, CutterIsInTheMiddleOfTheWallUnlessTheFileSaysWhere) {
  const Case middle = CaseFolder().read(tool + test::force + wall, Command::surface);
  EXPECT_DOUBLE_EQ(middle.machine.wall->position, 30.25e-3);
  EXPECT_NE(middle.as_understood.find("position_mm = 30.25\n"), std::string::npos);
  for (const double at_mm : {0.0, 60.5}) {
    const Case c = CaseFolder().read(
        tool + test::force + wall + "position_mm = " + std::to_string(at_mm) + "\n",
        Command::surface);
    EXPECT_DOUBLE_EQ(c.machine.wall->position, at_mm * 1e-3);
  }
}

TEST(CaseSurface, ReadsHeightsProbeAndFeedback) {
  const Case c = CaseFolder().read(tool + test::force + body + R"(
[surface]
model = "imprint"
load = "concentrated"
feedback = "direct"
phase_deg = 180
heights_mm = [0.0, 3.0, 1.5]
influence_heights_mm = [0.0, 83.0]
probe_diameter_mm = 1.0
)",
                                   Command::surface);
  const Surface& s = c.machine.surface.value();
  EXPECT_EQ(s.model, surface::Model::imprint);
  EXPECT_EQ(s.load, surface::Load::concentrated);
  EXPECT_EQ(s.feedback, surface::Feedback::direct);
  EXPECT_DOUBLE_EQ(s.phase, 3.141592653589793);
  EXPECT_EQ(s.heights, (std::vector{0.0, 3e-3, 1.5e-3}));
  EXPECT_EQ(s.influence_heights, (std::vector{0.0, 83e-3}));
  EXPECT_EQ(s.probe_diameter, 1e-3);
}

TEST(CaseSurface, HeightsOfTheSamplingStandInForItsOwn) {
  const std::string sampling = "[sampling]\nedge_heights_mm = [0.5, 1.0]\n";
  const Case c = CaseFolder().read(tool + test::force + sampling, Command::surface);
  EXPECT_EQ(c.machine.surface->heights, (std::vector{0.5e-3, 1e-3}));
  const Case own = CaseFolder().read(
      tool + test::force + sampling + "[surface]\nheights_mm = [2.0]\n",
      Command::surface);
  EXPECT_EQ(own.machine.surface->heights, (std::vector{2e-3}));
}

TEST(CaseSurface, CalibrateNeedsNoCoefficientsAndKnowsWhereTheFileIsNamed) {
  const CaseFolder folder;
  const auto file = folder.write("wall.csv", "x");
  const Case c =
      folder.read(tool + body + measured + "datum_tilt = true\n", Command::calibrate);
  ASSERT_EQ(c.machine.surface_measurements.size(), 1U);
  const SurfaceMeasurement& m = c.machine.surface_measurements[0];
  EXPECT_EQ(m.source.file.path, file.string());
  EXPECT_EQ(m.source.file.location, (folder.path() / "case.toml").string() + ":16:8");
  EXPECT_FALSE(m.datum_offset);
  EXPECT_TRUE(m.datum_tilt);
  EXPECT_TRUE(c.machine.surface.has_value());
  EXPECT_EQ(std::get<force::LinearEdge>(c.law).K_tc, 0.0);
}

TEST(CaseSurface, CheckAsksForWhatTheCaseIsMadeFor) {
  const CaseFolder folder;
  static_cast<void>(folder.write("wall.csv", "x"));
  static_cast<void>(folder.write("record.csv", "x"));
  const auto said = [&](const std::string& text) {
    return folder.problems(text, std::nullopt);
  };
  // No coefficients: in order where they are to be found.
  EXPECT_EQ(said(tool + body + measured), "");
  EXPECT_EQ(said(tool + body + "[[measurement]]\nfile = \"record.csv\"\n" + measured),
            "");
  EXPECT_NE(said(tool + body).find("[force] is missing"), std::string::npos);
  EXPECT_NE(said(tool + body).find("surface needs it"), std::string::npos);
  EXPECT_NE(said(tool + wall).find("surface needs it"), std::string::npos);
  // A rigid cut leaves its finish whatever the forces.
  EXPECT_EQ(said(tool + "[surface]\n"), "");
  EXPECT_NE(said(tool).find("simulate needs it"), std::string::npos);
}

TEST(CaseSurface, AnotherCommandMayCutASlotInTheSameFile) {
  EXPECT_EQ(CaseFolder().problems(test::slot + body + wall + "[surface]\n"), "");
}

/// What the case says of coordinates is written back as it stood, and computed with as
/// unit vectors.
TEST(CaseSurface, AFrameIsThreePerpendicularDirections) {
  const auto with = [](const std::string& frame) {
    return tool + body + wall + measured + "frame = { " + frame + " }\n";
  };
  CaseFolder folder;
  folder.write("wall.csv", "x_mm,y_mm,z_mm\n1,1,1\n");
  const Case axes = folder.read(
      with("origin_mm = [12.5, -5, 40], feed = \"x\", normal = \"-y\", up = \"+Z\""),
      Command::calibrate);
  const files::SurfaceFrame& frame =
      axes.machine.surface_measurements.at(0).source.frame.value();
  EXPECT_EQ(frame.origin, (std::vector<double>{12.5e-3, -5e-3, 40e-3}));
  EXPECT_EQ(*frame.feed, (files::Direction{1, 0, 0}));
  EXPECT_EQ(*frame.normal, (files::Direction{0, -1, 0}));
  EXPECT_EQ(*frame.up, (files::Direction{0, 0, 1}));
  EXPECT_NE(
      axes.as_understood.find("frame = { origin_mm = [12.5, -5, 40], feed = \"+x\", "
                              "normal = \"-y\", up = \"+z\" }\n"),
      std::string::npos)
      << axes.as_understood;
  // Without up the three are right-handed; numbers need not be exact.
  const Case numbers = folder.read(
      with("feed = [0.707, 0.707, 0], normal = [-2, 2.004, 0]"), Command::calibrate);
  const files::SurfaceFrame& turned =
      numbers.machine.surface_measurements.at(0).source.frame.value();
  EXPECT_NEAR((*turned.up)[2], 1.0, 1e-15);
  double cosine = 0.0;
  for (std::size_t i = 0; i < 3; ++i) cosine += (*turned.feed)[i] * (*turned.normal)[i];
  EXPECT_NEAR(cosine, 0.0, 1e-15);
  EXPECT_NEAR((*turned.feed)[0], 0.7071, 1e-3);
  EXPECT_NE(numbers.as_understood.find("normal = [-2, 2.004, 0]"), std::string::npos);
}

}  // namespace trochoid::cases::case_surface_test
