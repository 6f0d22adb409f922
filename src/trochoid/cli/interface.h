#pragma once

#include <trochoid/cli/commands.h>

#include <array>
#include <functional>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace trochoid::cli {

/// What the command line chose.
struct Chosen {
  Options options;
  std::string wanted;            ///< of new: the command
  std::function<int()> command;  ///< answers with an exit code
};

/// An exit code and what it means, for help and man page.
struct ExitCode {
  int code;
  std::string_view meaning;
};
inline constexpr std::array exit_codes{
    ExitCode{answered, "answered"},
    ExitCode{no_answer, "no good answer exists (the reason is given)"},
    ExitCode{wrong_input, "the input is wrong"}, ExitCode{our_bug, "a bug of ours"}};

/// What to start with, a line a command.
inline constexpr std::array<std::string_view, 2> first_steps{
    "trochoid new identify mycase.toml", "trochoid identify mycase.toml"};

/// The types of what follows an option or a command, as help shows them: completion knows
/// by them what to look for.
namespace types {
inline constexpr std::string_view data = "DATA";  ///< a case, or a bare data file
inline constexpr std::string_view file = "FILE";
inline constexpr std::string_view folder = "FOLDER";
inline constexpr std::string_view command = "COMMAND";
}  // namespace types

/// @brief Every command and option, into an empty App.
///
/// @param chosen  what is parsed goes there; must live as long as the App
void add_interface(CLI::App& app, Chosen& chosen);

}  // namespace trochoid::cli
