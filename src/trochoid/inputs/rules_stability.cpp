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

/// A diagram of one row or column: [5000, 5000, 1].
bool is_one_value(const std::optional<base::Steps>& steps) {
  return steps && steps->count == 1 && steps->first == steps->last;
}

}  // namespace

void check_steps(const std::optional<base::Steps>& steps, const std::string& key,
                 std::string_view what, double most, Findings& findings) {
  if (!steps || !sound(findings, {key})) {
    return;
  }
  const double whole = std::round(steps->count);
  if (steps->first >= steps->last || steps->count != whole || whole < 2 ||
      whole > most) {
    const double unit = unit_of(key).factor;
    report(findings, key,
           fmt::format(
               "{} = [{}, {}, {}]: no range; must be first < last, then a whole "
               "number of {} from 2 to {:.0f}",
               key, number_text(steps->first, unit), number_text(steps->last, unit),
               number_text(steps->count), what, most));
  }
}

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
  if (!is_one_value(s.spindle_speed)) {
    check_steps(s.spindle_speed, "stability.spindle_rpm", "values", most_points,
                findings);
  }
  if (!is_one_value(s.axial_depth)) {
    check_steps(s.axial_depth, "stability.axial_depth_mm", "values", most_points,
                findings);
  }
  if (!s.spindle_speed) {
    const double speed = t.cut.spindle_speed;
    s.spindle_speed = base::Steps{as_written(0.5 * speed, unit::rpm),
                                  as_written(1.5 * speed, unit::rpm), 101};
  }
  if (!s.axial_depth) {
    const double depth = t.cut.axial_depth;
    s.axial_depth = base::Steps{as_written(0.04 * depth, unit::mm),
                                as_written(2 * depth, unit::mm), 50};
  }
}

}  // namespace trochoid::inputs
