#include "case_text.h"

#include <gtest/gtest.h>

#include <numbers>

namespace trochoid::cases::case_default_test {

using test::CaseFolder;

TEST(CaseDefaults, ToolIsACylinderOfEqualPitchAndConstantLead) {
  const Case c = CaseFolder().read(test::slot);
  EXPECT_EQ(c.title, "");
  const geometry::Cutter& cutter = c.setup.cutter;
  EXPECT_DOUBLE_EQ(cutter.profile.D, 8e-3);
  EXPECT_EQ(cutter.profile.R, 0.0);
  EXPECT_DOUBLE_EQ(cutter.profile.Rr, 4e-3);
  EXPECT_EQ(cutter.profile.alpha, 0.0);
  EXPECT_EQ(cutter.profile.beta, 0.0);
  ASSERT_EQ(cutter.teeth(), 2);
  EXPECT_DOUBLE_EQ(cutter.pitch[0], std::numbers::pi);
  EXPECT_EQ(cutter.pitch[0], cutter.pitch[1]);
  EXPECT_EQ(cutter.lag_law, geometry::LagLaw::constant_lead);
  EXPECT_EQ(cutter.lag_diameter, cutter.profile.D);
  EXPECT_FALSE(c.gauge_length.has_value());
}

TEST(CaseDefaults, RunoutIsNone) {
  const geometry::Runout runout = CaseFolder().read(test::slot).setup.runout;
  EXPECT_EQ(runout.radial_offsets, (std::vector<double>{0.0, 0.0}));
  EXPECT_EQ(runout.eccentricity, 0.0);
  EXPECT_EQ(runout.angle, 0.0);
  EXPECT_EQ(runout.order, geometry::EccentricityOrder::exact);
}

TEST(CaseDefaults, ChipLawAndEdge) {
  const Case c = CaseFolder().read(test::slot);
  EXPECT_EQ(c.setup.chip.model, chip::Model::trochoidal);
  EXPECT_EQ(c.setup.chip.lookback, chip::Lookback::all);
  EXPECT_TRUE(std::holds_alternative<force::LinearEdge>(c.law));
  EXPECT_EQ(c.setup.edge_length, force::EdgeLength::true_length);
}

TEST(CaseDefaults, SamplingIsOneRevolutionOf720) {
  const Sampling s = CaseFolder().read(test::slot).sampling;
  EXPECT_EQ(s.samples_per_rev, 720);
  EXPECT_EQ(s.revolutions, 1.0);
  EXPECT_EQ(s.start, 0.0);
  EXPECT_TRUE(s.angles.empty());
  EXPECT_TRUE(s.edge_angles.empty());
  EXPECT_TRUE(s.edge_heights.empty());
  EXPECT_EQ(s.tolerance, 1e-6);
}

TEST(CaseDefaults, NoDynamometerNoMeasurementNoOtherTable) {
  const Case c = CaseFolder().read(test::slot);
  EXPECT_FALSE(c.dynamometer.has_value());
  EXPECT_TRUE(c.measurements.empty());
  EXPECT_FALSE(c.machine.cutter_body || c.machine.wall || c.machine.surface ||
               c.machine.actuator || c.machine.command || c.machine.correct);
  EXPECT_TRUE(c.machine.surface_measurements.empty());
  EXPECT_TRUE(c.machine.modes.empty());
}

TEST(CaseDefaults, IdentifyNeedsNoCoefficients) {
  const CaseFolder folder;
  const auto record = folder.write("record.csv", "angle_deg,Fx_N,Fy_N,Fz_N\n0,1,2,3\n");
  const Case c =
      folder.read(test::tool + test::cut + "[[measurement]]\nfile = \"record.csv\"\n",
                  Command::identify);
  const auto& law = std::get<force::LinearEdge>(c.law);
  EXPECT_EQ(law.K_tc, 0.0);
  ASSERT_EQ(c.measurements.size(), 1U);
  const Measurement& m = c.measurements[0];
  EXPECT_EQ(m.source.file.path, record);
  EXPECT_FALSE(m.source.format.has_value());
  EXPECT_TRUE(m.source.columns.empty());
  EXPECT_EQ(m.source.angle_column + m.source.time_column, "");
  EXPECT_FALSE(m.source.sample_rate.has_value());
  EXPECT_EQ(m.cut.f_z, c.setup.cut.f_z);
  EXPECT_EQ(m.source.file.location, (folder.path() / "case.toml").string() + ":11:8");
  const Identify& i = c.identify;
  EXPECT_EQ(i.chip_models, (std::vector{chip::Model::none, chip::Model::feed,
                                        chip::Model::trochoidal}));
  EXPECT_EQ(i.runout, std::nullopt) << "decided by the record";
  EXPECT_FALSE(i.phase.has_value());
  EXPECT_EQ(i.band_harmonics, std::nullopt) << "chosen from the record";
  EXPECT_EQ(i.errors, identification::Errors::automatic);
  EXPECT_EQ(i.channel_offsets, ChannelOffset::automatic);
  EXPECT_FALSE(i.sweep.has_value());
}

TEST(CaseDefaults, ExponentsOfAPowerLawStartAtAQuarterInIdentifyOnly) {
  const CaseFolder folder;
  static_cast<void>(folder.write("record.csv", "x"));
  const std::string text =
      test::tool + test::cut + "[force]\nlaw = \"power\"\nm_t = 0.3\n";
  const Case c =
      folder.read(text + "[[measurement]]\nfile = \"record.csv\"\n", Command::identify);
  const auto& law = std::get<force::Power>(c.law);
  EXPECT_EQ(law.m_t, 0.3);
  EXPECT_EQ(law.m_r, 0.25);
  EXPECT_EQ(law.m_a, 0.25);
  EXPECT_NE(folder.problems(text).find("force.m_r is missing"), std::string::npos);
}

TEST(CaseDefaults, OtherTables) {
  const CaseFolder folder;
  static_cast<void>(folder.write("wall.csv", "x"));
  const Case c = folder.read(test::slot + R"(
[cutter_body]
overhang_mm = 83.0
youngs_modulus_GPa = 206
[surface]
[correct]
[[surface_measurement]]
file = "wall.csv"
[actuator]
time_constants_s = [0.0011, 0.0012]
[command]
peak_to_peak_um = 26
)");
  EXPECT_DOUBLE_EQ(c.machine.cutter_body->flute_length.value(), 83e-3);
  EXPECT_DOUBLE_EQ(c.machine.cutter_body->shank_diameter.value(), 8e-3);
  EXPECT_DOUBLE_EQ(c.machine.cutter_body->equivalent_diameter.value(), 6.4e-3);
  EXPECT_EQ(c.machine.surface->model, surface::Model::envelope);
  EXPECT_EQ(c.machine.surface->load, surface::Load::distributed);
  EXPECT_EQ(c.machine.surface->feedback, std::nullopt);
  EXPECT_EQ(c.machine.surface->phase, 0.0);
  EXPECT_FALSE(c.machine.surface_measurements[0].datum_offset);
  EXPECT_EQ(c.machine.correct->options.target, correction::Target::peak_force);
  EXPECT_EQ(c.machine.correct->options.strategy, correction::Method::inverse);
  EXPECT_EQ(c.machine.actuator->gain, 1.0);
  EXPECT_EQ(c.machine.command->shape, CommandShape::sine);
  EXPECT_EQ(c.machine.command->lead, 0.0);
}

}  // namespace trochoid::cases::case_default_test
