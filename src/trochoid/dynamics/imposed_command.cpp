#include <trochoid/dynamics/imposed_command.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>

namespace trochoid::dynamics {

namespace {

/// How long a trapezoid goes from 0 to its level [turns].
constexpr double ramp = 1.0 / 6;

/// The command over one turn, from -1 to 1.
double shape_at(CommandShape shape, double angle) {
  const double u = angle / unit::turn - std::floor(angle / unit::turn);
  switch (shape) {
    case CommandShape::square:
      return u < 0.5 ? 1.0 : -1.0;
    case CommandShape::trapezoid: {
      const double near_zero = u < 0.25 ? u : (u < 0.75 ? 0.5 - u : u - 1);
      return std::clamp(2 * near_zero / ramp, -1.0, 1.0);
    }
    case CommandShape::sine:
    case CommandShape::table:
      break;
  }
  return std::sin(angle);
}

CommandTable about_its_mean(CommandTable table) {
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

}  // namespace

double command_at(const CommandTable& table, double angle) noexcept {
  const double from = table.angle.front();
  const double at =
      from + std::fmod(std::fmod(angle - from, unit::turn) + unit::turn, unit::turn);
  const auto next = std::upper_bound(table.angle.begin(), table.angle.end(), at);
  const auto k = static_cast<std::size_t>(next - table.angle.begin()) - 1;
  const bool last = k + 1 == table.angle.size();
  const double to = last ? from + unit::turn : table.angle[k + 1];
  const double end = last ? table.command.front() : table.command[k + 1];
  const double share = (at - table.angle[k]) / (to - table.angle[k]);
  return (1 - share) * table.command[k] + share * end;
}

std::function<double(double t)> command_over_time(const ImposedCommand& command,
                                                  double Omega) {
  if (command.shape == CommandShape::table) {
    return [table = about_its_mean(command.table), lead = command.lead,
            Omega](double t) { return command_at(table, Omega * (t + lead)); };
  }
  return [shape = command.shape, half = 0.5 * command.peak_to_peak, lead = command.lead,
          Omega](double t) { return half * shape_at(shape, Omega * (t + lead)); };
}

}  // namespace trochoid::dynamics
