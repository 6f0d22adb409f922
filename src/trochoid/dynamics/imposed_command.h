#pragma once

#include <functional>
#include <string_view>
#include <vector>

namespace trochoid::dynamics {

/// How a command goes over one turn of the spindle.
enum class CommandShape { sine, square, trapezoid, table };

/// The names that files use.
constexpr std::string_view name_of(CommandShape shape) noexcept {
  switch (shape) {
    case CommandShape::sine:
      return "sine";
    case CommandShape::square:
      return "square";
    case CommandShape::trapezoid:
      return "trapezoid";
    case CommandShape::table:
      return "table";
  }
  return {};
}

/// A command over one turn of the spindle.
struct CommandTable {
  std::vector<double> angle;    ///< [rad], increasing, less than a turn from end to end
  std::vector<double> command;  ///< [m]
};

/// @brief The command at an angle: straight between the rows, and once around.
double command_at(const CommandTable& table, double angle) noexcept;

/// @brief A command that is imposed on the actuator of a table.
struct ImposedCommand {
  CommandShape shape = CommandShape::sine;
  double peak_to_peak = 0.0;  ///< [m]; not of a table
  CommandTable table;         ///< of the shape `table`
  double lead = 0.0;          ///< by how much it runs earlier [s]
};

/// @brief x_com [m] over t [s], about 0: the middle of the stroke moves nothing against
/// anything.
/// @param Omega  spindle speed [rad/s]
std::function<double(double t)> command_over_time(const ImposedCommand& command,
                                                  double Omega);

}  // namespace trochoid::dynamics
