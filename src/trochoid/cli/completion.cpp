#include <trochoid/cli/completion.h>

#include <trochoid/cli/interface.h>

namespace trochoid::cli {

namespace {

/// What `new` writes a case of: those that answer one.
std::vector<std::string> case_commands(const CommandTable& table) {
  for (const CommandEntry& command : table.commands) {
    for (const Argument& argument : command.positionals) {
      if (argument.names.front() == types::command) {
        return argument.choices;
      }
    }
  }
  return {};
}

}  // namespace

Candidates candidates(const Argument& argument, const CommandTable& table) {
  if (!argument.choices.empty()) {
    return {.words = argument.choices, .endings = {}};
  }
  if (argument.type == types::command) {
    return {.words = case_commands(table), .endings = {}};
  }
  if (argument.type == types::folder) {
    return {.words = {}, .endings = {}, .folders = true};
  }
  if (argument.type == types::data) {
    return {.words = {}, .endings = {"toml", "csv", "txt", "uff", "unv"}};
  }
  if (argument.type == types::file) {
    return {.words = {}, .endings = {"toml"}};
  }
  return {};
}

std::vector<std::string> option_names(const CommandEntry& command) {
  std::vector<std::string> names;
  for (const Argument& option : command.options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

}  // namespace trochoid::cli
