#include <trochoid/base/unit_of_key.h>
#include <trochoid/cases/number_text.h>
#include <trochoid/cases/rules.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::cases {

namespace {

/// More would take hours and fill the disk.
constexpr double most_points = 5000;

/// A diagram of one row or column: [5000, 5000, 1].
bool is_one_value(const std::optional<base::Steps>& steps) {
  return steps && steps->count == 1 && steps->first == steps->last;
}

/// So many vibrations between two teeth, or in a turn where they differ, take all memory
/// there is; the lobes have long become one line.
void check_slowest(const CaseTables& t, double Omega, const std::string& key,
                   Findings& findings) {
  constexpr double most_vibrations = 4000;
  double fastest = 0.0;
  for (const Mode& mode : t.machine.modes) {
    fastest = std::max(fastest, natural_frequency(mode));
  }
  const double vibrations = fastest * unit::turn / (Omega * std::max(1, t.tool.teeth));
  if (sound(findings, {key, "mode", "tool.teeth"}) && vibrations > most_vibrations) {
    report(
        findings, key,
        fmt::format("{}: {} rpm: {:.3g} vibrations of the mode at {:.4g} Hz pass from "
                    "one tooth to the next; at most {:g} can be computed, from "
                    "{:.3g} rpm up",
                    key, number_text(Omega, unit::rpm), vibrations, fastest,
                    most_vibrations, Omega / unit::rpm * vibrations / most_vibrations));
  }
}

/// Something must vibrate: modes, or what was measured of them.
void check_what_vibrates(const MachineTables& machine, Findings& findings) {
  const bool measured = !machine.measured_frfs.empty();
  if (machine.modes.empty() && !measured && sound(findings, {"mode", "measured_frf"})) {
    report(findings, "mode",
           "[[mode]] is missing (a mode of vibration), and so is [[measured_frf]]; "
           "stability needs one of the two");
  }
  check_measured_frfs(machine.measured_frfs, findings);
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
    const double unit = unit::of_key(key).factor;
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
  check_what_vibrates(t.machine, findings);
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
  if (t.cut.spindle_speed > 0) {
    check_slowest(t, t.cut.spindle_speed, "cut.spindle_rpm", findings);
    if (s.spindle_speed->first > 0 && s.spindle_speed->first < t.cut.spindle_speed) {
      check_slowest(t, s.spindle_speed->first, "stability.spindle_rpm", findings);
    }
  }
  if (!s.axial_depth) {
    const double depth = t.cut.axial_depth;
    s.axial_depth = base::Steps{as_written(0.04 * depth, unit::mm),
                                as_written(2 * depth, unit::mm), 50};
  }
}

}  // namespace trochoid::cases
