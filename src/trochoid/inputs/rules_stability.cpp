#include <trochoid/inputs/number_text.h>
#include <trochoid/inputs/rules.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::inputs {

namespace {

/// More would take hours and fill the disk.
constexpr double most_points = 5000;

/// @param values  first, last, number; the number in the same unit as the others
void check_steps(const std::vector<double>& values, double unit, const std::string& key,
                 Findings& findings) {
  if (values.size() != 3 || !sound(findings, {key})) {
    return;
  }
  const double count = values[2] / unit;
  if (values[0] >= values[1] || std::abs(count - std::round(count)) > 1e-9 * count ||
      std::round(count) < 2 || std::round(count) > most_points) {
    report(
        findings, key,
        fmt::format("{} = [{}, {}, {}]: no range; must be first < last, then a whole "
                    "number of values from 2 to {:.0f}",
                    key, number_text(values[0], unit), number_text(values[1], unit),
                    number_text(values[2], unit), most_points));
  }
}

}  // namespace

void check_stability(CaseTables& t, Findings& findings) {
  const std::vector<Mode>& modes = t.machine.modes;
  const bool all_z = !modes.empty() &&
                     std::all_of(modes.begin(), modes.end(),
                                 [](const Mode& mode) { return mode.axis == Axis::z; });
  if (all_z && sound(findings, {"mode[1].axis"})) {
    report(findings, "mode[1].axis",
           "mode[1].axis = \"z\": no mode along x or y, which is what the chip feels; "
           "stability needs one");
  }
  if (!t.machine.stability) {
    t.machine.stability.emplace();
  }
  Stability& s = *t.machine.stability;
  check_steps(s.spindle_speed, unit::rpm, "stability.spindle_rpm", findings);
  check_steps(s.axial_depth, unit::mm, "stability.axial_depth_mm", findings);
  if (s.spindle_speed.empty()) {
    const double speed = t.cut.spindle_speed;
    s.spindle_speed = {as_written(0.5 * speed, unit::rpm),
                       as_written(1.5 * speed, unit::rpm), 101 * unit::rpm};
  }
  if (s.axial_depth.empty()) {
    const double depth = t.cut.axial_depth;
    s.axial_depth = {as_written(0.04 * depth, unit::mm),
                     as_written(2 * depth, unit::mm), 50 * unit::mm};
  }
}

}  // namespace trochoid::inputs
