#include "case_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace trochoid::cases::case_unit_test {

using test::CaseFolder;
constexpr double pi = std::numbers::pi;

TEST(CaseUnits, LengthsAnglesAndSpeedsBecomeSi) {
  const Case c = CaseFolder().read(R"(
[tool]
shape = "apt"
teeth = 3
diameter_mm = 12.0
helix_deg = 45.0
pitch_deg = [110.0, 120.0, 130.0]
corner_radius_mm = 2.0
corner_center_radius_mm = 4.2
corner_center_height_mm = 2.5
bottom_angle_deg = 10.0
taper_deg = 5.0
lag = "constant_helix"
lag_diameter_mm = 11.0
gauge_length_mm = 60.0
[runout]
radial_offsets_mm = [0.0, -0.008, 0.002]
eccentricity_mm = 0.01
angle_deg = 90.0
eccentricity_order = "first"
[cut]
engagement = "band"
stock_y_mm = [-10.0, 18.0]
axial_depth_mm = 4.0
feed_per_tooth_mm = 0.1
spindle_rpm = 3000
[chip]
model = "feed"
lookback = "previous"
[sampling]
samples_per_rev = 360
revolutions = 2.5
start_deg = 30
angles_deg = [0.137, 180]
edge_angles_deg = [90]
edge_heights_mm = [1.0]
tolerance = 1e-9
)" + test::force + "edge_length = \"axial\"\n");
  const geometry::Cutter& t = c.setup.cutter;
  EXPECT_DOUBLE_EQ(t.profile.D, 0.012);
  EXPECT_DOUBLE_EQ(t.profile.R, 0.002);
  EXPECT_DOUBLE_EQ(t.profile.Rr, 0.0042);
  EXPECT_DOUBLE_EQ(t.profile.Rz, 0.0025);
  EXPECT_DOUBLE_EQ(t.profile.alpha, pi / 18);
  EXPECT_DOUBLE_EQ(t.profile.beta, pi / 36);
  EXPECT_DOUBLE_EQ(t.helix, pi / 4);
  EXPECT_DOUBLE_EQ(t.pitch[0], 110 * pi / 180);
  EXPECT_DOUBLE_EQ(t.pitch[2], 130 * pi / 180);
  EXPECT_EQ(t.lag_law, geometry::LagLaw::constant_helix);
  EXPECT_DOUBLE_EQ(t.lag_diameter, 0.011);
  EXPECT_DOUBLE_EQ(c.gauge_length.value(), 0.06);
  EXPECT_DOUBLE_EQ(c.setup.runout.radial_offsets[1], -8e-6);
  EXPECT_DOUBLE_EQ(c.setup.runout.eccentricity, 1e-5);
  EXPECT_DOUBLE_EQ(c.setup.runout.angle, pi / 2);
  EXPECT_EQ(c.setup.runout.order, geometry::EccentricityOrder::first);
  const auto& band = std::get<geometry::Band>(c.setup.cut.engagement);
  EXPECT_DOUBLE_EQ(band.y_lo, -0.010);
  EXPECT_DOUBLE_EQ(band.y_hi, 0.018);
  EXPECT_DOUBLE_EQ(c.setup.cut.a_p, 0.004);
  EXPECT_DOUBLE_EQ(c.setup.cut.f_z, 1e-4);
  EXPECT_DOUBLE_EQ(c.setup.cut.Omega, 100 * pi);
  EXPECT_EQ(c.setup.chip.model, chip::Model::feed);
  EXPECT_EQ(c.setup.chip.lookback, chip::Lookback::previous);
  EXPECT_EQ(c.sampling.samples_per_rev, 360);
  EXPECT_EQ(c.sampling.revolutions, 2.5);
  EXPECT_DOUBLE_EQ(c.sampling.start, pi / 6);
  EXPECT_DOUBLE_EQ(c.sampling.angles[1], pi);
  EXPECT_DOUBLE_EQ(c.sampling.edge_angles[0], pi / 2);
  EXPECT_DOUBLE_EQ(c.sampling.edge_heights[0], 1e-3);
  EXPECT_EQ(c.sampling.tolerance, 1e-9);
  EXPECT_EQ(c.setup.edge_length, force::EdgeLength::axial);
}

TEST(CaseUnits, ProcessDamping) {
  const std::string worn =
      test::slot + "wear_land_um = 80\nindentation_N_per_mm3 = 30000\n";
  const CaseFolder folder;
  const Case c = folder.read(worn, Command::simulate);
  const force::ProcessDamping& damping = c.setup.process_damping;
  EXPECT_DOUBLE_EQ(damping.wear_land, 80e-6);
  EXPECT_DOUBLE_EQ(damping.indentation, 3e13);
  EXPECT_EQ(damping.friction, 0.3);  // the usual one
  EXPECT_NE(c.as_understood.find("flank_friction = 0.3"), std::string::npos);
  // What vibrates feels it; nothing else does, and says so.
  ASSERT_EQ(c.notes.size(), 1U);
  EXPECT_EQ(c.notes[0].code, "process_damping_ignored");
  const Case moving =
      folder.read(worn +
                      "[[mode]]\nbody = \"tool\"\naxis = \"x\"\nmass_kg = 0.04\n"
                      "frequency_Hz = 922\ndamping_ratio = 0.011\n",
                  Command::stability);
  EXPECT_TRUE(moving.notes.empty());
  // The material may be given without the land: a sharp edge.
  const Case sharp = folder.read(test::slot + "indentation_N_per_mm3 = 30000\n");
  EXPECT_FALSE(sharp.setup.process_damping.acts());
  EXPECT_TRUE(sharp.notes.empty());
  EXPECT_EQ(sharp.as_understood.find("flank_friction"), std::string::npos);
}

TEST(CaseUnits, Coefficients) {
  const Case linear = CaseFolder().read(test::slot);
  const auto& e = std::get<force::LinearEdge>(linear.law);
  EXPECT_DOUBLE_EQ(e.K_tc, 2620e6);
  EXPECT_DOUBLE_EQ(e.K_rc, 1560e6);
  EXPECT_DOUBLE_EQ(e.K_ac, 331e6);
  EXPECT_DOUBLE_EQ(e.K_te, 7e3);
  EXPECT_DOUBLE_EQ(e.K_re, 3e3);
  EXPECT_DOUBLE_EQ(e.K_ae, 1e3);
  const Case power = CaseFolder().read(test::tool + test::cut + R"(
[force]
law = "power"
K_t1_MPa = 1500
m_t = 0.2
K_r1_MPa = 700
m_r = 0.3
K_a1_MPa = 300
m_a = 0.4
)");
  const auto& p = std::get<force::Power>(power.law);
  EXPECT_DOUBLE_EQ(p.K_t1, 1500e6);
  EXPECT_DOUBLE_EQ(p.K_r1, 700e6);
  EXPECT_DOUBLE_EQ(p.K_a1, 300e6);
  EXPECT_EQ(p.m_t, 0.2);
  EXPECT_EQ(p.m_r, 0.3);
  EXPECT_EQ(p.m_a, 0.4);
}

TEST(CaseUnits, CoefficientsOfALawThatSharesKeysWithOthers) {
  const Case given = CaseFolder().read(test::tool + test::cut + R"(
[force]
law = "power_edge"
K_t1_MPa = 1500
m_t = 0.2
K_r1_MPa = 700
m_r = 0.3
K_a1_MPa = 300
m_a = 0.4
K_te_N_per_mm = 7
K_re_N_per_mm = 3
K_ae_N_per_mm = 1
)");
  const auto& law = std::get<force::PowerEdge>(given.law);
  EXPECT_DOUBLE_EQ(law.K_r1, 700e6);
  EXPECT_EQ(law.m_a, 0.4);
  EXPECT_DOUBLE_EQ(law.K_te, 7e3);
  EXPECT_DOUBLE_EQ(law.K_ae, 1e3);
}

TEST(CaseUnits, FeedRateIsFeedPerToothTimesTeethTimesSpeed) {
  std::string rate = test::slot;
  rate.replace(rate.find("feed_per_tooth_mm = 0.04"), 24,
               "feed_rate_mm_per_min = 70.0");
  const CaseFolder folder;
  EXPECT_NEAR(folder.read(rate).setup.cut.f_z, 4e-5, 1e-19);
  std::string both = test::slot;
  both.replace(both.find("spindle_rpm"), 0, "feed_rate_mm_per_min = 70.0\n");
  EXPECT_EQ(folder.read(both).setup.cut.f_z, 0.04 * 1e-3);
}

TEST(CaseUnits, FeedZeroIsValid) {
  std::string text = test::slot;
  text.replace(text.find("0.04"), 4, "0");
  EXPECT_EQ(CaseFolder().read(text).setup.cut.f_z, 0.0);
}

TEST(CaseUnits, EveryShape) {
  const CaseFolder folder;
  const auto profile = [&](const std::string& keys) {
    return folder
        .read("[tool]\nteeth = 2\ndiameter_mm = 10\nhelix_deg = 30\n" + keys +
              test::cut + test::force)
        .setup.cutter.profile;
  };
  EXPECT_DOUBLE_EQ(profile("shape = \"ball\"\n").R, 5e-3);
  const auto bull = profile("shape = \"bull_nose\"\ncorner_radius_mm = 2\n");
  EXPECT_DOUBLE_EQ(bull.R, 2e-3);
  EXPECT_DOUBLE_EQ(bull.Rr, 3e-3);
  const auto sharp = profile("shape = \"taper\"\ntaper_deg = 3\n");
  EXPECT_EQ(sharp.R, 0.0);
  EXPECT_DOUBLE_EQ(sharp.beta, pi / 60);
  const auto round =
      profile("shape = \"taper\"\ntaper_deg = 3\ncorner_radius_mm = 1\n");
  EXPECT_DOUBLE_EQ(round.R, 1e-3);
  EXPECT_DOUBLE_EQ(round.Rz, 1e-3);
}

TEST(CaseUnits, ParametersThatAreZeroAnywayMayBeWritten) {
  EXPECT_EQ(CaseFolder().problems("[tool]\nteeth = 2\ndiameter_mm = 8\nhelix_deg = 30\n"
                                  "corner_radius_mm = 0.0\ntaper_deg = 0.0\n"
                                  "bottom_angle_deg = 0.0\n"
                                  "corner_center_height_mm = 0\n" +
                                  test::cut + test::force),
            "");
}

TEST(CaseUnits, EveryEngagement) {
  const CaseFolder folder;
  const auto engagement = [&](const std::string& keys) {
    std::string text = test::slot;
    text.replace(text.find("engagement = \"slot\""), 19, keys);
    return folder.read(text).setup.cut.engagement;
  };
  EXPECT_TRUE(
      std::holds_alternative<geometry::Slot>(engagement("engagement = \"slot\"")));
  EXPECT_DOUBLE_EQ(std::get<geometry::UpMilling>(
                       engagement("engagement = \"up\"\nradial_depth_mm = 1"))
                       .a_e,
                   1e-3);
  EXPECT_DOUBLE_EQ(std::get<geometry::DownMilling>(
                       engagement("engagement = \"down\"\nradial_depth_mm = 8"))
                       .a_e,
                   8e-3);
}

TEST(CaseUnits, RoundedPitchesAreSpreadOverTheTurn) {
  std::string text = test::slot;
  text.replace(text.find("teeth = 2"), 9,
               "teeth = 3\npitch_deg = [120.00001, 120.00001, 120.00001]");
  double sum = 0;
  for (const double pitch : CaseFolder().read(text).setup.cutter.pitch) {
    sum += pitch;
  }
  EXPECT_NEAR(sum, 2 * pi, 1e-14);
}

}  // namespace trochoid::cases::case_unit_test
