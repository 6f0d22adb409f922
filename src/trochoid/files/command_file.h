#pragma once

#include <trochoid/dynamics/imposed_command.h>
#include <trochoid/files/file_ref.h>

#include <istream>
#include <string>

namespace trochoid::files {

using dynamics::CommandTable;

/// @brief Read the file of `[command]`: CSV with columns `angle` and `command`, units
/// in the names, as `correct` writes it.
/// @throws base::InputError with every problem of the file
CommandTable read_command(const FileRef& file);

/// @brief The same from an open stream.
/// @param name  of the file, for messages
CommandTable read_command(std::istream& in, const std::string& name);

}  // namespace trochoid::files
