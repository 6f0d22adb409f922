#include <trochoid/inputs/case.h>
#include <trochoid/run/surface.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

namespace trochoid::run {
namespace {

const std::string cut = R"(
[tool]
shape = "cylinder"
teeth = 3
diameter_mm = 12
helix_deg = 45
[cut]
engagement = "up"
radial_depth_mm = 1
axial_depth_mm = 3
feed_per_tooth_mm = 0.2
spindle_rpm = 1000
[force]
law = "linear_edge"
K_tc_MPa = 400
K_rc_MPa = 200
K_ac_MPa = 0
K_te_N_per_mm = 4
K_re_N_per_mm = 2
K_ae_N_per_mm = 0
[sampling]
samples_per_rev = 90
)";

const std::string cutter = R"(
[cutter_body]
overhang_mm = 83
flute_length_mm = 45
shank_diameter_mm = 10
youngs_modulus_GPa = 206
)";

const std::string wall = R"(
[wall]
length_mm = 60
height_mm = 30
thickness_mm = 2
youngs_modulus_GPa = 69
poisson_ratio = 0.33
position_mm = 20
)";

results::Answer answer(const std::string& bodies, const std::string& load) {
  const auto file = std::filesystem::path(testing::TempDir()) / "bent_test.toml";
  std::ofstream(file) << cut << bodies << "[surface]\nload = \"" << load
                      << "\"\nheights_mm = [0.0, 1.5, 3.0]\n";
  return surface(inputs::read_case(file, inputs::Command::surface), {});
}

const base::Table* table_named(const results::Answer& answer, const char* file) {
  const auto table = std::find_if(answer.tables.begin(), answer.tables.end(),
                                  [&](const base::Table& t) { return t.file == file; });
  return table == answer.tables.end() ? nullptr : &*table;
}

/// At the angle of the largest force, by height.
std::map<double, double> deflections(const results::Answer& answer) {
  const base::Table& forces = *table_named(answer, "forces.csv");
  const auto& F = forces.columns[2].values;
  const auto peak = static_cast<std::size_t>(
      std::max_element(F.begin(), F.end(),
                       [](double a, double b) { return std::abs(a) < std::abs(b); }) -
      F.begin());
  const double angle = forces.columns[0].values[peak];
  const base::Table& t = *table_named(answer, "deflection.csv");
  std::map<double, double> found;
  for (std::size_t i = 0; i < t.columns[0].values.size(); ++i) {
    if (t.columns[0].values[i] == angle) {
      found[t.columns[1].values[i]] = t.columns[2].values[i];
    }
  }
  return found;
}

TEST(Bent, CutterAndWallAddUpToTheDeflectionUnderEitherLoad) {  // [E-5] [E-6]
  for (const char* load : {"distributed", "concentrated"}) {
    const results::Answer given = answer(cutter + wall, load);
    const base::Table* bent = table_named(given, "bent.csv");
    ASSERT_NE(bent, nullptr);
    const auto expected = deflections(given);
    ASSERT_EQ(expected.size(), 3U);
    int compared = 0;
    for (const auto& [height, deflection] : expected) {
      for (std::size_t i = 0; i < bent->columns[0].values.size(); ++i) {
        if (std::abs(bent->columns[0].values[i] - height) < 1e-9) {
          const double both = bent->columns[1].values[i] + bent->columns[2].values[i];
          EXPECT_NEAR(both, deflection, 1e-9 * std::abs(deflection)) << load << height;
          EXPECT_GT(std::abs(deflection), 1e-4);
          ++compared;
        }
      }
    }
    EXPECT_EQ(compared, 3) << load;
  }
}

TEST(Bent, IsNothingWhereTheBodiesAreHeldOrDoNotReach) {
  const results::Answer given = answer(cutter + wall, "distributed");
  const base::Table& bent = *table_named(given, "bent.csv");
  const auto& height = bent.columns[0].values;
  EXPECT_NEAR(height.front(), -27.0, 1e-9);
  EXPECT_NEAR(height.back(), 83.0, 1e-9);
  EXPECT_TRUE(std::is_sorted(height.begin(), height.end()));
  EXPECT_NEAR(bent.columns[1].values.back(), 0.0, 1e-15);
  EXPECT_NEAR(bent.columns[2].values.front(), 0.0, 1e-15);
  for (std::size_t i = 0; i < height.size(); ++i) {
    if (height[i] < -1e-9) {
      EXPECT_EQ(bent.columns[1].values[i], 0.0);
    }
    if (height[i] > 3.0 + 1e-9) {
      EXPECT_EQ(bent.columns[2].values[i], 0.0);
    }
  }
}

TEST(Bent, IsToldOfOneBodyAloneAndNotOfNone) {
  const results::Answer one = answer(wall, "distributed");
  const base::Table& bent = *table_named(one, "bent.csv");
  EXPECT_NEAR(bent.columns[0].values.back(), 3.0, 1e-9);
  for (const double u : bent.columns[1].values) {
    EXPECT_EQ(u, 0.0);
  }
  EXPECT_EQ(table_named(answer("", "distributed"), "bent.csv"), nullptr);
}

}  // namespace
}  // namespace trochoid::run
