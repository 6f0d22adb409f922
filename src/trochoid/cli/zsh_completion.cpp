#include <trochoid/cli/completion.h>
#include <trochoid/cli/manual.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <string_view>

namespace trochoid::cli {

namespace {

/// Within '...' of an argument of _arguments.
std::string in_zsh(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
    } else if (c == '[' || c == ']' || c == ':' || c == '\\') {
      out += fmt::format("\\{}", c);
    } else {
      out += c;
    }
  }
  return out;
}

std::string action_in_zsh(const Candidates& found) {
  if (!found.words.empty()) {
    return fmt::format("({})", fmt::join(found.words, " "));
  }
  if (found.folders) {
    return "_files -/";
  }
  if (!found.endings.empty()) {
    return fmt::format("_files -g \"*.({})(-.)\"", fmt::join(found.endings, "|"));
  }
  return " ";
}

std::string argument_in_zsh(const std::string& name, const Argument& option,
                            const CommandTable& table) {
  std::string text = fmt::format("'{}[{}]", name, in_zsh(option.meaning));
  if (takes_value(option)) {
    text +=
        fmt::format(":{}:{}", option.type, action_in_zsh(candidates(option, table)));
  }
  return text + "'";
}

std::string arguments_in_zsh(const CommandEntry& command, const CommandTable& table) {
  std::string text;
  for (const Argument& option : command.options) {
    for (const std::string& name : option.names) {
      text += " \\\n        " + argument_in_zsh(name, option, table);
    }
  }
  for (const Argument& argument : command.positionals) {
    text += fmt::format(" \\\n        '{}:{}:{}'", argument.required ? "" : ":",
                        in_zsh(argument.names.front()),
                        action_in_zsh(candidates(argument, table)));
  }
  return text;
}

}  // namespace

std::string zsh_completion(const CommandTable& table) {
  std::string commands;
  std::string cases;
  for (const CommandEntry& command : table.commands) {
    commands += fmt::format("    '{}:{}'\n", command.name, in_zsh(command.purpose));
    cases += fmt::format("    {})\n      _arguments{}\n      ;;\n", command.name,
                         arguments_in_zsh(command, table));
  }
  return fmt::format(
      "#compdef trochoid\n# Made by `trochoid --manual zsh`.\n"
      "_trochoid() {{\n  local -a commands=(\n{}  )\n"
      "  if (( CURRENT == 2 )); then\n"
      "    _describe -t commands command commands\n    _arguments{}\n    return\n  fi\n"
      "  shift words\n  (( CURRENT-- ))\n  case $words[1] in\n{}  esac\n}}\n"
      "_trochoid \"$@\"\n",
      commands, arguments_in_zsh(table.program, table), cases);
}

}  // namespace trochoid::cli
