#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

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

}  // namespace trochoid::cli
