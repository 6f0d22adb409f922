#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/cases/case.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace trochoid::run::test {

/// [tool], [cut], [chip] and [force] of a small cut.
inline const std::string cut_tables = R"(
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
[chip]
model = "feed"
[force]
law = "linear_edge"
K_tc_MPa = 400
K_rc_MPa = 200
K_ac_MPa = 0
K_te_N_per_mm = 4
K_re_N_per_mm = 2
K_ae_N_per_mm = 0
)";

inline const std::string cutter_table = R"(
[cutter_body]
overhang_mm = 83
flute_length_mm = 45
shank_diameter_mm = 10
youngs_modulus_GPa = 206
)";

inline const std::string wall_table = R"(
[wall]
length_mm = 60
height_mm = 30
thickness_mm = 2
youngs_modulus_GPa = 69
poisson_ratio = 0.33
position_mm = 20
)";

/// A file in the folder of the tests.
inline std::filesystem::path written(const std::string& name, const std::string& text) {
  const auto file =
      std::filesystem::path(testing::TempDir()) / ("trochoid_wall_" + name);
  std::ofstream(file) << text;
  return file;
}

inline cases::Case case_of(const std::string& text,
                           cases::Command command = cases::Command::surface) {
  const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
  return cases::read_case(written(std::string(test->name()) + ".toml", text), command);
}

template <class Result>
bool warned(const Result& result, const std::string& code) {
  for (const base::Warning& warning : result.heading.warnings) {
    if (warning.code == code) {
      return true;
    }
  }
  return false;
}

}  // namespace trochoid::run::test
