#include "case_text.h"

#include <trochoid/base/units.h>
#include <trochoid/cases/number_text.h>

#include <gtest/gtest.h>

#include <random>

namespace trochoid::cases::case_round_trip_test {

using test::CaseFolder;

void expect_equal(const geometry::Cut& a, const geometry::Cut& b) {
  const auto band_a = geometry::stock_band(a.engagement, 0.01);
  const auto band_b = geometry::stock_band(b.engagement, 0.01);
  EXPECT_EQ(a.engagement.index(), b.engagement.index());
  EXPECT_EQ(band_a.y_lo, band_b.y_lo);
  EXPECT_EQ(band_a.y_hi, band_b.y_hi);
  EXPECT_EQ(a.a_p, b.a_p);
  EXPECT_EQ(a.f_z, b.f_z);
  EXPECT_EQ(a.Omega, b.Omega);
}

void expect_equal(const force::Setup& a, const force::Setup& b) {
  const geometry::Profile& p = a.cutter.profile;
  const geometry::Profile& q = b.cutter.profile;
  EXPECT_EQ((std::array{p.D, p.R, p.Rr, p.Rz, p.alpha, p.beta}),
            (std::array{q.D, q.R, q.Rr, q.Rz, q.alpha, q.beta}));
  EXPECT_EQ(a.cutter.pitch, b.cutter.pitch);
  EXPECT_EQ(a.cutter.helix, b.cutter.helix);
  EXPECT_EQ(a.cutter.lag_law, b.cutter.lag_law);
  EXPECT_EQ(a.cutter.lag_diameter, b.cutter.lag_diameter);
  EXPECT_EQ(a.runout.radial_offsets, b.runout.radial_offsets);
  EXPECT_EQ(a.runout.eccentricity, b.runout.eccentricity);
  EXPECT_EQ(a.runout.angle, b.runout.angle);
  EXPECT_EQ(a.runout.order, b.runout.order);
  expect_equal(a.cut, b.cut);
  EXPECT_EQ(a.chip.model, b.chip.model);
  EXPECT_EQ(a.chip.lookback, b.chip.lookback);
  EXPECT_EQ(a.edge_length, b.edge_length);
  EXPECT_EQ(a.process_damping.wear_land, b.process_damping.wear_land);
  EXPECT_EQ(a.process_damping.indentation, b.process_damping.indentation);
  EXPECT_EQ(a.process_damping.friction, b.process_damping.friction);
}

std::vector<double> numbers(const force::Law& law) {
  std::vector<double> all = force::coefficients(law);
  const auto m = force::form(law).m;
  all.insert(all.end(), m.begin(), m.end());
  return all;
}

void expect_equal(const Sampling& a, const Sampling& b) {
  EXPECT_EQ(a.samples_per_rev, b.samples_per_rev);
  EXPECT_EQ(a.revolutions, b.revolutions);
  EXPECT_EQ(a.start, b.start);
  EXPECT_EQ(a.angles, b.angles);
  EXPECT_EQ(a.edge_angles, b.edge_angles);
  EXPECT_EQ(a.edge_heights, b.edge_heights);
  EXPECT_EQ(a.tolerance, b.tolerance);
}

void expect_equal(const Identify& a, const Identify& b) {
  EXPECT_EQ(a.chip_models, b.chip_models);
  EXPECT_EQ(a.runout, b.runout);
  EXPECT_EQ(a.phase, b.phase);
  EXPECT_EQ(a.band_harmonics, b.band_harmonics);
  EXPECT_EQ(a.channel_offsets, b.channel_offsets);
  ASSERT_EQ(a.sweep.has_value(), b.sweep.has_value());
  if (a.sweep) {
    EXPECT_EQ(a.sweep->first, b.sweep->first);
    EXPECT_EQ(a.sweep->last, b.sweep->last);
    EXPECT_EQ(a.sweep->count, b.sweep->count);
  }
}

void expect_equal(const Measurement& a, const Measurement& b) {
  EXPECT_EQ(a.source.file.path, b.source.file.path);
  EXPECT_EQ(a.source.format, b.source.format);
  EXPECT_EQ(a.source.columns, b.source.columns);
  EXPECT_EQ(a.source.angle_column, b.source.angle_column);
  EXPECT_EQ(a.source.time_column, b.source.time_column);
  EXPECT_EQ(a.source.sample_rate, b.source.sample_rate);
  EXPECT_EQ(a.source.scale, b.source.scale);
  EXPECT_EQ(a.source.pulse_column, b.source.pulse_column);
  expect_equal(a.cut, b.cut);
}

void expect_equal(const MachineTables& a, const MachineTables& b) {
  ASSERT_EQ(a.wall.has_value(), b.wall.has_value());
  if (a.wall) {
    EXPECT_EQ(a.wall->position, b.wall->position);
    EXPECT_EQ(a.wall->thickness, b.wall->thickness);
  }
  ASSERT_EQ(a.surface.has_value(), b.surface.has_value());
  if (a.surface) {
    EXPECT_EQ(a.surface->model, b.surface->model);
    EXPECT_EQ(a.surface->load, b.surface->load);
    EXPECT_EQ(a.surface->feedback, b.surface->feedback);
    EXPECT_EQ(a.surface->phase, b.surface->phase);
    EXPECT_EQ(a.surface->heights, b.surface->heights);
    EXPECT_EQ(a.surface->influence_heights, b.surface->influence_heights);
    EXPECT_EQ(a.surface->probe_diameter, b.surface->probe_diameter);
  }
  ASSERT_EQ(a.surface_measurements.size(), b.surface_measurements.size());
  for (std::size_t i = 0; i < a.surface_measurements.size(); ++i) {
    const auto& m = a.surface_measurements[i];
    const auto& n = b.surface_measurements[i];
    EXPECT_EQ(m.source.file.path, n.source.file.path);
    EXPECT_EQ(m.datum_offset, n.datum_offset);
    EXPECT_EQ(m.datum_tilt, n.datum_tilt);
  }
}

void expect_equal(const Case& a, const Case& b) {
  EXPECT_EQ(a.title, b.title);
  expect_equal(a.setup, b.setup);
  EXPECT_EQ(a.law.index(), b.law.index());
  EXPECT_EQ(numbers(a.law), numbers(b.law));
  EXPECT_EQ(a.gauge_length, b.gauge_length);
  expect_equal(a.sampling, b.sampling);
  ASSERT_EQ(a.dynamometer.has_value(), b.dynamometer.has_value());
  if (a.dynamometer) {
    EXPECT_EQ(a.dynamometer->automatic, b.dynamometer->automatic);
    EXPECT_EQ(a.dynamometer->matrix, b.dynamometer->matrix);
  }
  ASSERT_EQ(a.measurements.size(), b.measurements.size());
  for (std::size_t i = 0; i < a.measurements.size(); ++i) {
    expect_equal(a.measurements[i], b.measurements[i]);
  }
  expect_equal(a.identify, b.identify);
  expect_equal(a.machine, b.machine);
}

void expect_round_trip(const std::string& text, std::optional<Command> command) {
  const CaseFolder folder;
  static_cast<void>(folder.write("run 1.csv", "x"));
  static_cast<void>(folder.write("wall.csv", "x"));
  const auto results = folder.path() / "case.results";
  const Case first = read_case(folder.write("case.toml", text), command, results);
  SCOPED_TRACE(first.as_understood);
  const auto echo = folder.write("case.results/case.toml", first.as_understood);
  const Case second = read_case(echo, command, results);
  expect_equal(first, second);
  EXPECT_EQ(first.as_understood, second.as_understood);
}

const std::string crooked = R"(
title = "with \"quotes\", a tab\t, a \\ and an ä"
[tool]
shape = "taper"
teeth = 7
diameter_mm = 7.123456789012345
helix_deg = 33.333333333333336
taper_deg = 0.7
corner_radius_mm = 0.3
gauge_length_mm = 61.7
[runout]
radial_offsets_mm = [0.0, -0.0083, 1e-7, 0.1, 0.2, 0.3, 0.0070000000000000001]
eccentricity_mm = 0.0123
angle_deg = -77.7
eccentricity_order = "first"
[cut]
engagement = "up"
radial_depth_mm = 1.1
axial_depth_mm = 3.3
feed_rate_mm_per_min = 333.3
spindle_rpm = 1234.5
)";

TEST(CaseRoundTrip, SimulateWithCrookedNumbers) {
  expect_round_trip(crooked + test::force + R"(
wear_land_um = 80.7
indentation_N_per_mm3 = 30000.3
flank_friction = 0.17
[sampling]
samples_per_rev = 100
revolutions = 1.5
start_deg = 0.137
angles_deg = [0.1, 0.2, 0.30000000000000004, 1e3]
edge_angles_deg = [10, 20.7]
edge_heights_mm = [0.0, 0.7]
tolerance = 3e-7
[dynamometer]
matrix = [[0.98, 0.01, 0.0], [0.0, -1.02, 0.003], [0.1, 0.2, 3e-1]]
)",
                    Command::simulate);
}

TEST(CaseRoundTrip, IdentifyWithOverrides) {
  expect_round_trip(crooked + R"(
[chip]
lookback = "previous"
[force]
law = "power"
m_r = 0.31
[dynamometer]
axes = ["-y", "+x", "z"]
[[measurement]]
file = "run 1.csv"
format = "csv"
columns = ["a", "b c", "d\"e"]
angle_column = "phi"
[[measurement]]
file = "run 1.csv"
sample_rate_Hz = 5000.5
scale = [500.5, -500, 1e3]
pulse_column = "index"
cut = { feed_per_tooth_mm = 0.07, engagement = "band", stock_y_mm = [-1.1, 2.3] }
[identify]
chip_models = ["trochoidal", "none"]
runout = "eccentricity"
phase_deg = -12.3
band_harmonics = 9
channel_offsets = "idle"
sweep_um = [-20.1, 20.3, 41]
)",
                    Command::identify);
}

TEST(CaseRoundTrip, AFeedThatFollowsFromTheRate) {
  // 39.7 / 3000 mm is among the numbers whose SI
  // value no number of a file meets exactly.
  for (const char* rate : {"39.7", "100", "333.3", "1000"}) {
    std::string text = test::slot;
    text.replace(text.find("feed_per_tooth_mm = 0.04"), 24,
                 std::string("feed_rate_mm_per_min = ") + rate);
    text.replace(text.find("teeth = 2"), 9, "teeth = 3");
    text.replace(text.find("875"), 3, "1000");
    expect_round_trip(text, Command::simulate);
  }
}

TEST(CaseRoundTrip, AutomaticAxesAndFreePhase) {
  expect_round_trip(test::slot + R"(
[dynamometer]
axes = "auto"
[[measurement]]
file = "run 1.csv"
[identify]
phase_deg = "free"
)",
                    std::nullopt);
}

TEST(CaseRoundTrip, TablesOfOtherCommands) {
  expect_round_trip(test::slot + R"(
[cutter_body]
overhang_mm = 83.1
flute_length_mm = 45
shank_diameter_mm = 12
equivalent_diameter_mm = 9.6
youngs_modulus_GPa = 206.3
[wall]
length_mm = 60
height_mm = 30
thickness_mm = 2.1
youngs_modulus_GPa = 69
poisson_ratio = 0.33
position_mm = 30
[surface]
model = "quasi_static"
load = "concentrated"
feedback = "entry"
phase_deg = 12.5
heights_mm = [0.1, 1.7]
influence_heights_mm = [0.3, 45.1]
probe_diameter_mm = 1.1
[[surface_measurement]]
file = "wall.csv"
datum_offset = true
datum_tilt = true
[[mode]]
body = "tool"
axis = "x"
mass_kg = 0.03242
stiffness_N_per_m = 8e6
damping_Ns_per_m = 25.46
[[mode]]
body = "table"
axis = "y"
frequency_Hz = 140.3
stiffness_N_per_m = 1.7e7
damping_ratio = 0.02
[actuator]
gain = 0.99536
time_constants_s = [0.0011303, 0.0011376]
stroke_um = [0, 60]
coupling_stiffness_N_per_m = 1.7e7
slew_um_per_s = 1e5
[command]
shape = "trapezoid"
peak_to_peak_um = 26
lead_s = 0.0022679
[correct]
target = "chip_area"
strategy = "learning"
)",
                    Command::simulate);
}

TEST(CaseRoundTrip, CalibrateWithAWallWhoseMiddleIsCrooked) {
  std::string text = test::tool + test::cut + R"(
[cutter_body]
overhang_mm = 83.1
youngs_modulus_GPa = 206.3
[wall]
length_mm = 60.123456789012345
height_mm = 30
thickness_mm = 2.1
youngs_modulus_GPa = 69
poisson_ratio = 0.33
[sampling]
edge_heights_mm = [0.1, 0.30000000000000004]
[[surface_measurement]]
file = "wall.csv"
)";
  const std::string slot = "engagement = \"slot\"";
  text.replace(text.find(slot), slot.size(),
               "engagement = \"up\"\nradial_depth_mm = 1.1");
  expect_round_trip(text, Command::calibrate);
}

TEST(CaseRoundTrip, EchoNamesFilesFromTheResultFolderOrInFull) {
  const CaseFolder folder;
  static_cast<void>(folder.write("run.csv", "x"));
  const auto file = folder.write(
      "case.toml", test::tool + test::cut + "[[measurement]]\nfile = \"run.csv\"\n");
  const auto near = read_case(file, Command::identify, folder.path() / "case.identify");
  EXPECT_NE(near.as_understood.find("file = \"../run.csv\""), std::string::npos);
  const auto full = read_case(file, Command::identify);
  EXPECT_NE(full.as_understood.find("file = \"" + (folder.path() / "run.csv").string()),
            std::string::npos);
}

TEST(NumberText, IsShortestAndReadsBackInTheUnitOfTheFile) {
  EXPECT_EQ(number_text(0.008 * unit::mm, unit::mm), "0.008");
  EXPECT_EQ(number_text(30.0 * unit::deg, unit::deg), "30");
  EXPECT_EQ(number_text(875 * unit::rpm, unit::rpm), "875");
  EXPECT_EQ(number_text(0.1 + 0.2), "0.30000000000000004");
  std::mt19937_64 random(20090401);
  std::uniform_real_distribution<double> any(1e-3, 1e3);
  for (int i = 0; i < 20000; ++i) {
    const double number = any(random);
    for (const double unit : {unit::mm, unit::um, unit::deg, unit::rpm, unit::MPa}) {
      const double si = number * unit;
      ASSERT_EQ(std::stod(number_text(si, unit)) * unit, si) << number << " " << unit;
    }
  }
}

TEST(NumberText, AComputedDefaultSurvivesWriting) {
  std::mt19937_64 random(20090402);
  std::uniform_real_distribution<double> any(1e-3, 1e3);
  for (int i = 0; i < 20000; ++i) {
    for (const double unit : {unit::mm, unit::deg}) {
      const double si = as_written(any(random), unit);
      ASSERT_EQ(std::stod(number_text(si, unit)) * unit, si);
    }
  }
}

}  // namespace trochoid::cases::case_round_trip_test
