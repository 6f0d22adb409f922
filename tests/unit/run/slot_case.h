#pragma once

#include <string>

namespace trochoid::run {

/// A tool of two teeth with one mode, in a cut that chatters where it is much deeper.
/// @param cut  `engagement` and what belongs to it
inline std::string small_cut(const std::string& cut, const std::string& depth_mm,
                             int rpm) {
  return R"(
[tool]
teeth = 2
diameter_mm = 10
helix_deg = 0
[cut]
)" + cut +
         "\naxial_depth_mm = " + depth_mm +
         "\nfeed_per_tooth_mm = 0.05\nspindle_rpm = " + std::to_string(rpm) + R"(
[chip]
model = "none"
[force]
K_tc_MPa = 600
K_rc_MPa = 200
K_ac_MPa = 0
K_te_N_per_mm = 0
K_re_N_per_mm = 0
K_ae_N_per_mm = 0
)";
}

/// One mode of 922 Hz along the feed.
inline const std::string one_mode = R"([[mode]]
body = "tool"
axis = "x"
mass_kg = 0.03993
frequency_Hz = 922
damping_ratio = 0.011
)";

}  // namespace trochoid::run
