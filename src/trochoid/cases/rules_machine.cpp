#include <trochoid/cases/number_text.h>
#include <trochoid/cases/rules.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <cmath>

namespace trochoid::cases {

double natural_frequency(const Mode& mode) {
  if (mode.frequency) {
    return *mode.frequency;
  }
  return mode.mass && mode.stiffness && *mode.mass > 0
             ? std::sqrt(*mode.stiffness / *mode.mass) / unit::turn
             : 0.0;
}

namespace {

/// What mass and stiffness make of a frequency that is given as well.
std::string contradiction(const Mode& mode) {
  if (!mode.mass || !mode.stiffness || !mode.frequency || !(*mode.mass > 0.0) ||
      !(*mode.frequency > 0.0)) {
    return "";
  }
  const double made = std::sqrt(*mode.stiffness / *mode.mass) / unit::turn;
  return fmt::format(" (stiffness and mass make {:.4g} Hz, {:+.2g} % off {:g} Hz)",
                     made, 100.0 * (made / *mode.frequency - 1.0), *mode.frequency);
}

void check_mode(const Mode& mode, const std::string& path, Findings& findings) {
  if (!sound(findings,
             {path + ".mass_kg", path + ".stiffness_N_per_m", path + ".frequency_Hz",
              path + ".damping_Ns_per_m", path + ".damping_ratio"})) {
    return;
  }
  const int given = int{mode.mass.has_value()} + int{mode.stiffness.has_value()} +
                    int{mode.frequency.has_value()};
  if (given != 2) {
    report(
        findings, path,
        fmt::format("{}: {} of mass_kg, stiffness_N_per_m and frequency_Hz are given; "
                    "must be 2, the third follows{}",
                    path, given, contradiction(mode)));
  }
  const double frequency = natural_frequency(mode);
  if (given == 2 && !mode.frequency &&
      !(frequency >= slowest_Hz && frequency <= fastest_Hz)) {
    report(findings, path + ".stiffness_N_per_m",
           fmt::format("{}.stiffness_N_per_m and mass_kg make a natural frequency of "
                       "{:g} Hz; must be from {:g} to {:g} Hz",
                       path, frequency, slowest_Hz, fastest_Hz));
  }
  if (mode.damping.has_value() == mode.damping_ratio.has_value()) {
    report(
        findings, path,
        fmt::format("{}: {} of damping_Ns_per_m and damping_ratio given; must be one "
                    "of the two",
                    path, mode.damping ? "both" : "none"));
  }
}

void check_actuator(const Actuator& a, Findings& findings) {
  if (!sound(findings, {"actuator.time_constants_s", "actuator.frequency_Hz",
                        "actuator.damping_ratio", "actuator.stroke_um"})) {
    return;
  }
  const bool lags = !a.time_constants.empty();
  if (lags == (a.frequency || a.damping_ratio) ||
      a.frequency.has_value() != a.damping_ratio.has_value()) {
    report(findings, "actuator",
           "actuator: must have either time_constants_s, or "
           "frequency_Hz and damping_ratio");
  }
  if (a.stroke.size() == 2 && a.stroke[0] >= a.stroke[1]) {
    report(findings, "actuator.stroke_um",
           fmt::format(
               "actuator.stroke_um = [{}, {}]: not in order; must be the lowest, "
               "then the highest position",
               number_text(a.stroke[0], unit::um), number_text(a.stroke[1], unit::um)));
  }
}

void settle_wall(Wall& wall, Findings& findings) {
  if (!sound(findings, {"wall.position_mm", "wall.length_mm"})) {
    return;
  }
  if (findings.places.count("wall.position_mm") == 0) {
    wall.position = wall.length / 2;
  }
  if (wall.position > wall.length) {
    report(findings, "wall.position_mm",
           fmt::format("wall.position_mm = {} mm: beyond length_mm = {} mm (where the "
                       "cutter is along the wall)",
                       number_text(wall.position, unit::mm),
                       number_text(wall.length, unit::mm)));
  }
}

void settle_body(CutterBody& body, const ToolTable& tool, Findings& findings) {
  if (!sound(findings, {"cutter_body.overhang_mm", "cutter_body.flute_length_mm",
                        "tool.diameter_mm"})) {
    return;
  }
  body.flute_length = body.flute_length.value_or(body.overhang);
  body.shank_diameter = body.shank_diameter.value_or(tool.diameter);
  body.equivalent_diameter =
      body.equivalent_diameter.value_or(as_written(0.8 * tool.diameter, unit::mm));
  if (*body.flute_length > body.overhang) {
    report(findings, "cutter_body.flute_length_mm",
           fmt::format("cutter_body.flute_length_mm = {} mm: longer than overhang_mm = "
                       "{} mm (length of the fluted part)",
                       number_text(*body.flute_length, unit::mm),
                       number_text(body.overhang, unit::mm)));
  }
}

void check_band(const FrfTables& frf, Findings& findings) {
  if (frf.band.size() == 2 && sound(findings, {"frf.band_Hz"}) &&
      frf.band[0] >= frf.band[1]) {
    report(findings, "frf.band_Hz",
           fmt::format("frf.band_Hz = [{}, {}]: not in order; must be the lowest, then "
                       "the highest frequency",
                       frf.band[0], frf.band[1]));
  }
}

void check_step(const files::StepSource& step, Findings& findings) {
  if (step.step && *step.step == 0 && sound(findings, {"step.step_um"})) {
    report(findings, "step.step_um",
           "step.step_um = 0: no step at all; must not "
           "be 0 (height of the commanded step)");
  }
}

}  // namespace

void check_machine(MachineTables& machine, const ToolTable& tool, Findings& findings) {
  if (machine.cutter_body) {
    settle_body(*machine.cutter_body, tool, findings);
  }
  for (std::size_t i = 0; i < machine.modes.size(); ++i) {
    check_mode(machine.modes[i], fmt::format("mode[{}]", i + 1), findings);
  }
  if (machine.actuator) {
    check_actuator(*machine.actuator, findings);
  }
  if (machine.frf) {
    check_band(*machine.frf, findings);
  }
  if (machine.step) {
    check_step(machine.step->source, findings);
  }
  if (machine.wall) {
    settle_wall(*machine.wall, findings);
    check_wall_loads(*machine.wall, findings);
  }
}

}  // namespace trochoid::cases
