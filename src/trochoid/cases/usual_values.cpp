#include <trochoid/cases/usual_values.h>

#include <algorithm>
#include <array>
#include <string>

namespace trochoid::cases {

namespace {

constexpr std::array values = {
    UsualValue{"tool.teeth", between(1, 20)},
    UsualValue{"tool.diameter_mm", between(0.1, 250)},
    UsualValue{"tool.helix_deg", between(-30, 60)},
    UsualValue{"tool.pitch_deg", between(10, 360)},
    UsualValue{"tool.corner_radius_mm", between(0, 50)},
    UsualValue{"runout.radial_offsets_mm", between(-0.2, 0.2)},
    UsualValue{"runout.eccentricity_mm", between(0, 0.2)},
    UsualValue{"cut.radial_depth_mm", between(0.005, 250)},
    UsualValue{"cut.axial_depth_mm", between(0.005, 100)},
    UsualValue{"cut.feed_per_tooth_mm", between(0, 1)},
    UsualValue{"cut.feed_rate_mm_per_min", between(0, 30000)},
    UsualValue{"cut.spindle_rpm", between(10, 80000)},
    UsualValue{"force.K_tc_MPa", between(50, 15000)},
    UsualValue{"force.K_rc_MPa", between(-500, 15000)},
    UsualValue{"force.K_ac_MPa", between(-5000, 15000)},
    UsualValue{"force.K_te_N_per_mm", between(-5, 200)},
    UsualValue{"force.K_re_N_per_mm", between(-5, 200)},
    UsualValue{"force.K_ae_N_per_mm", between(-100, 200)},
    UsualValue{"force.K_t1_MPa", between(50, 15000)},
    UsualValue{"force.K_r1_MPa", between(-500, 15000)},
    UsualValue{"force.K_a1_MPa", between(-5000, 15000)},
    UsualValue{"force.wear_land_um", between(0, 500)},
    UsualValue{"force.indentation_N_per_mm3", between(1e3, 1e6)},
    UsualValue{"force.flank_friction", between(0, 1)},
    UsualValue{"cutter_body.overhang_mm", between(2, 500)},
    UsualValue{"cutter_body.shank_diameter_mm", between(1, 250)},
    UsualValue{"cutter_body.youngs_modulus_GPa", between(50, 750)},
    UsualValue{"wall.length_mm", between(5, 2000)},
    UsualValue{"wall.height_mm", between(1, 500)},
    UsualValue{"wall.thickness_mm", between(0.1, 50)},
    UsualValue{"wall.youngs_modulus_GPa", between(1, 450)},
    UsualValue{"surface.probe_diameter_mm", between(0.005, 20)},
    UsualValue{"mode.mass_kg", between(1e-4, 1e4)},
    UsualValue{"mode.stiffness_N_per_m", between(1e4, 1e10)},
    UsualValue{"mode.frequency_Hz", between(5, 20000)},
    UsualValue{"mode.damping_ratio", between(1e-3, 0.3)},
    UsualValue{"actuator.stroke_um", between(-2000, 2000)},
    UsualValue{"command.peak_to_peak_um", between(0, 500)},
};

bool is_digit_of_place(char c) noexcept {
  return c >= '0' && c <= '9';
}

/// The last two names of a path, without numbers of entries.
std::string table_and_key(std::string_view path) {
  std::string plain;
  for (const char c : path) {
    if (c != '[' && c != ']' &&
        !(is_digit_of_place(c) && plain.find('.') == plain.npos)) {
      plain += c;
    }
  }
  const auto key = plain.rfind('.');
  const auto table =
      key == 0 || key == plain.npos ? plain.npos : plain.rfind('.', key - 1);
  return table == plain.npos ? plain : plain.substr(table + 1);
}

}  // namespace

std::span<const UsualValue> usual_values() {
  return values;
}

const Range* usual_range(std::string_view path) {
  const std::string name = table_and_key(path);
  const auto found = std::find_if(values.begin(), values.end(),
                                  [&](const UsualValue& v) { return v.key == name; });
  return found == values.end() ? nullptr : &found->range;
}

}  // namespace trochoid::cases
