#pragma once

#include <trochoid/cli/command_table.h>

#include <string>

namespace trochoid::cli {

/// @brief The man page, in the language of man(7).
std::string man_page(const CommandTable& table);

/// @brief What a shell completes of a command line, as a script in its language.
std::string bash_completion(const CommandTable& table);
std::string zsh_completion(const CommandTable& table);
std::string fish_completion(const CommandTable& table);

/// @brief The option --manual, which help does not tell: prints one of these.
void add_manual(CLI::App& app);

}  // namespace trochoid::cli
