#pragma once

#include <trochoid/inputs/machine_tables.h>

#include <istream>
#include <string>
#include <vector>

namespace trochoid::inputs {

/// A command over one turn of the spindle.
struct CommandTable {
  std::vector<double> angle;    ///< [rad], increasing, less than a turn from end to end
  std::vector<double> command;  ///< [m]
};

/// @brief Read the file of `[command]`: CSV with columns `angle` and `command`, units
/// in the names, as `correct` writes it.
/// @throws base::InputError with every problem of the file
CommandTable read_command(const ImposedCommand& command);

/// @brief The same from an open stream.
/// @param name  of the file, for messages
CommandTable read_command(std::istream& in, const std::string& name);

/// @brief The command at an angle: straight between the rows, and once around.
double command_at(const CommandTable& table, double angle) noexcept;

}  // namespace trochoid::inputs
