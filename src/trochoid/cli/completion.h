#pragma once

#include <trochoid/cli/command_table.h>

#include <string>
#include <vector>

namespace trochoid::cli {

/// What may stand where an argument does.
struct Candidates {
  std::vector<std::string> words;
  std::vector<std::string> endings;  ///< of files
  bool folders = false;              ///< no files
};

/// @brief What may follow an option, or stand as an argument of a command.
Candidates candidates(const Argument& argument, const CommandTable& table);

/// @brief -o, --output and the rest.
std::vector<std::string> option_names(const CommandEntry& command);

}  // namespace trochoid::cli
