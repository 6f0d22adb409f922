#pragma once

#include <trochoid/cli/commands.h>
#include <trochoid/results/answer.h>

#include <string>

namespace trochoid::cli {

/// @brief Result folder of a command: -o, or CASE.COMMAND beside the case.
std::filesystem::path result_folder(const Options& options, const std::string& command);

/// @brief Write the folder of an answer and print what a person wants to see.
/// @return exit code
int deliver(const results::Answer& answer, const Options& options);

/// @brief Put it on the standard error, without what a terminal would obey; where that
/// cannot be written, nowhere.
void complain(const std::string& text) noexcept;

}  // namespace trochoid::cli
