#include <trochoid/cases/number_text.h>
#include <trochoid/cases/rules.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::cases {

namespace {

void check_modes(const MachineTables& machine, Findings& findings) {
  const auto along = [&](ModeBody body, Axis axis) {
    return std::any_of(
        machine.modes.begin(), machine.modes.end(), [&](const Mode& mode) {
          return mode.body == body && mode.axis == axis && mode.angle == 0;
        });
  };
  const auto only_z = [](const Mode& mode) { return mode.axis == Axis::z; };
  if (!machine.modes.empty() &&
      std::all_of(machine.modes.begin(), machine.modes.end(), only_z) &&
      sound(findings, {"mode[1].axis"})) {
    report(findings, "mode[1].axis",
           "mode[1].axis = \"z\": no mode along x or y, which is what the chip feels; "
           "dynamics needs one");
  }
  if (machine.actuator && !along(ModeBody::table, Axis::x) &&
      sound(findings, {"actuator", "mode"})) {
    report(
        findings, "actuator",
        "[actuator]: there is no [[mode]] with body = \"table\" and axis = \"x\" for "
        "it to push");
  }
  if (machine.command && !machine.actuator) {
    report(findings, "command",
           "[command]: there is no [actuator] that could follow it");
  }
}

}  // namespace

void check_dynamics(const CaseTables& t, Findings& findings) {
  if (t.tool.shape != Shape::cylinder && sound(findings, {"tool.shape"})) {
    report(findings, "tool.shape",
           "tool.shape: motion in time is computed for a cylinder only");
  }
  const double turns = t.sampling.revolutions;
  if ((turns != std::floor(turns) || turns < 1) &&
      sound(findings, {"sampling.revolutions"})) {
    report(
        findings, "sampling.revolutions",
        fmt::format("sampling.revolutions = {}: must be a whole number of at least 1, "
                    "from the start of the motion",
                    number_text(turns)));
  }
  check_modes(t.machine, findings);
}

}  // namespace trochoid::cases
