#include <trochoid/run/motion_problem.h>

#include <trochoid/base/units.h>
#include <trochoid/inputs/command_file.h>
#include <trochoid/run/chip_modes.h>
#include <trochoid/run/machine_plant.h>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

/// Last turns that are returned.
constexpr int turns_kept = 2;

/// The command over one turn, from -1 to 1.
double shape_at(inputs::CommandShape shape, double angle) {
  const double u = angle / unit::turn - std::floor(angle / unit::turn);
  constexpr double ramp = 1.0 / 6;  // of a turn
  switch (shape) {
    case inputs::CommandShape::square:
      return u < 0.5 ? 1.0 : -1.0;
    case inputs::CommandShape::trapezoid: {
      const double near_zero = u < 0.25 ? u : (u < 0.75 ? 0.5 - u : u - 1);
      return std::clamp(2 * near_zero / ramp, -1.0, 1.0);
    }
    default:
      return std::sin(angle);
  }
}

/// The middle of the stroke moves nothing against anything.
inputs::CommandTable around_its_mean(inputs::CommandTable table) {
  double mean = 0.0;
  const std::size_t n = table.angle.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double to = i + 1 < n ? table.angle[i + 1] : table.angle[0] + unit::turn;
    mean += (to - table.angle[i]) / unit::turn *
            (table.command[i] + table.command[(i + 1) % n]) / 2;
  }
  for (double& value : table.command) {
    value -= mean;
  }
  return table;
}

dynamics::Drive drive_of(const inputs::MachineTables& machine,
                         const dynamics::System& system) {
  const auto table =
      std::find_if(system.modes.begin(), system.modes.end(),
                   [](const dynamics::ChipMode& mode) { return mode.x < 0; });
  return correction::drive_of(plant_of(machine),
                              static_cast<std::size_t>(table - system.modes.begin()));
}

}  // namespace

dynamics::MotionProblem motion_problem(const inputs::Case& given) {
  dynamics::MotionProblem p{.setup = given.setup,
                            .law = given.law,
                            .system = chip_modes(given.machine.modes)};
  if (given.machine.actuator) {
    p.drive = drive_of(given.machine, p.system);
  }
  const double omega = given.setup.cut.Omega;
  if (given.machine.command) {
    const inputs::ImposedCommand& c = *given.machine.command;
    if (c.shape == inputs::CommandShape::table) {
      p.command = [table = around_its_mean(inputs::read_command(c)), lead = c.lead,
                   omega](double t) {
        return inputs::command_at(table, omega * (t + lead));
      };
    } else {
      p.command = [c, omega](double t) {
        return 0.5 * *c.peak_to_peak * shape_at(c.shape, omega * (t + c.lead));
      };
    }
  }
  p.grid.steps_per_tooth = dynamics::steps_needed(p);
  p.revolutions = static_cast<int>(given.sampling.revolutions);
  p.kept = std::min(p.revolutions, turns_kept);
  p.samples_per_rev = given.sampling.samples_per_rev;
  return p;
}

}  // namespace trochoid::run
