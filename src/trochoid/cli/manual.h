#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

/// What --help tells, for man page and completion.
namespace trochoid::cli {

/// One option, or one argument that stands without a name.
struct Argument {
  std::vector<std::string> names;  ///< -o and --output; CASE.toml
  std::string type;                ///< of what follows an option; empty: nothing does
  std::vector<std::string> choices;
  std::string range;  ///< 1 - 20
  std::string meaning;
  bool required = false;

  bool operator==(const Argument&) const = default;
};

/// A command, or the program itself.
struct CommandEntry {
  std::string name;
  std::string purpose;
  std::vector<Argument> options;
  std::vector<Argument> positionals;
};

/// All that --help tells, for man page and completion.
struct CommandTable {
  CommandEntry program;
  std::vector<CommandEntry> commands;
};

/// @brief What an App tells in its help, in that order.
CommandTable command_table(const CLI::App& app);

/// Whether an option is followed by something.
inline bool takes_value(const Argument& option) {
  return !option.type.empty();
}

/// @brief The man page, in the language of man(7).
std::string man_page(const CommandTable& table);

/// @brief What a shell completes of a command line, as a script in its language.
std::string bash_completion(const CommandTable& table);
std::string zsh_completion(const CommandTable& table);
std::string fish_completion(const CommandTable& table);

/// @brief The option --manual, which help does not tell: prints one of these.
void add_manual(CLI::App& app);

}  // namespace trochoid::cli
