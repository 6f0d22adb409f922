#include <trochoid/cli/manual.h>

#include <trochoid/cli/interface.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <string_view>

namespace trochoid::cli {

namespace {

/// What may stand where an argument does.
struct Candidates {
  std::vector<std::string> words;
  std::vector<std::string> endings;  ///< of files
  bool folders = false;              ///< no files
};

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

/// What may follow an option, or stand as an argument of a command.
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

/// -o, --output and the rest.
std::vector<std::string> option_names(const CommandEntry& command) {
  std::vector<std::string> names;
  for (const Argument& option : command.options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

std::string in_bash(const Candidates& found) {
  if (!found.words.empty()) {
    return fmt::format("_trochoid_words '{}'", fmt::join(found.words, " "));
  }
  if (found.folders) {
    return "_trochoid_files -d";
  }
  if (!found.endings.empty()) {
    return fmt::format("_trochoid_files -f {}", fmt::join(found.endings, " "));
  }
  return "return";
}

/// What may follow the options of a command: patterns with the command and the word before.
std::string options_in_bash(const CommandEntry& command, const CommandTable& table) {
  std::string cases;
  for (const Argument& option : command.options) {
    if (!takes_value(option)) {
      continue;
    }
    for (const std::string& name : option.names) {
      cases += fmt::format("    {}\\ {}) {}; return ;;\n", command.name, name,
                           in_bash(candidates(option, table)));
    }
  }
  return cases;
}

constexpr std::string_view bash_head =
    R"(# Completion of trochoid in bash; made by `trochoid --manual bash`.
_trochoid_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word"); }

# -d: folders; -f ENDING...: files that end so, and the folders on the way to them
_trochoid_files() {
  local kind=$1 ending
  shift
  compopt -o filenames
  mapfile -t COMPREPLY < <(compgen -d -- "$word")
  [ "$kind" = -d ] && return
  for ending; do
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -X "!*.$ending" -- "$word")
  done
}

_trochoid() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  local command=${COMP_WORDS[1]} at place=0
  COMPREPLY=()
  if [ "$word" = = ]; then  # --output=
    word=
  elif [ "$before" = = ]; then
    before=${COMP_WORDS[COMP_CWORD - 2]}
  fi
)";

constexpr std::string_view bash_places = R"(
  # How many arguments without a name stand before this one; values of options are counted
  # as well, for all but `new` take the same file at any place.
  for ((at = 2; at < COMP_CWORD; ++at)); do
    [[ ${COMP_WORDS[at]} == -* ]] || ((++place))
  done
)";

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

std::string in_fish(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    out += c == '\'' || c == '\\' ? fmt::format("\\{}", c) : std::string(1, c);
  }
  return out + "'";
}

/// The arguments of `complete` that say what may follow.
std::string candidates_in_fish(const Candidates& found) {
  if (!found.words.empty()) {
    return fmt::format(" -a '{}'", fmt::join(found.words, " "));
  }
  if (found.folders) {
    return " -a '(__fish_complete_directories)'";
  }
  std::string endings;
  for (const std::string& ending : found.endings) {
    endings += fmt::format("(__fish_complete_suffix .{})", ending);
  }
  return endings.empty() ? "" : fmt::format(" -a '{}'", endings);
}

std::string option_in_fish(const Argument& option, const std::string& when,
                           const CommandTable& table) {
  std::string text = "complete -c trochoid" + when;
  for (const std::string& name : option.names) {
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (takes_value(option)) {
    text += " -x" + candidates_in_fish(candidates(option, table));
  }
  return text + " -d " + in_fish(option.meaning) + "\n";
}

}  // namespace

std::string bash_completion(const CommandTable& table) {
  std::string values;
  std::string places;
  for (const CommandEntry& command : table.commands) {
    values += options_in_bash(command, table);
    std::size_t place = 0;
    for (const Argument& argument : command.positionals) {
      const bool last = ++place == command.positionals.size();
      places += fmt::format("    {}\\ {}) {} ;;\n", command.name,
                            last ? "*" : std::to_string(place - 1),
                            in_bash(candidates(argument, table)));
    }
  }
  std::vector<std::string> commands;
  std::string names;
  for (const CommandEntry& command : table.commands) {
    commands.push_back(command.name);
    names += fmt::format("      {}) _trochoid_words '{}' ;;\n", command.name,
                         fmt::join(option_names(command), " "));
  }
  return fmt::format(
      "{}  if [ \"$COMP_CWORD\" = 1 ]; then\n    _trochoid_words '{} {}'\n    return\n"
      "  fi\n  case \"$command $before\" in\n{}  esac\n"
      "  if [[ $word == -* ]]; then\n    case $command in\n{}    esac\n    return\n  fi\n"
      "{}  case \"$command $place\" in\n{}  esac\n}}\ncomplete -F _trochoid trochoid\n",
      bash_head, fmt::join(commands, " "), fmt::join(option_names(table.program), " "),
      values, names, bash_places, places);
}

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

std::string fish_completion(const CommandTable& table) {
  std::string text =
      "# Completion of trochoid in fish; made by `trochoid --manual fish`.\n"
      "complete -c trochoid -f\n";
  for (const Argument& option : table.program.options) {
    text += option_in_fish(option, " -n __fish_use_subcommand", table);
  }
  for (const CommandEntry& command : table.commands) {
    text += fmt::format("complete -c trochoid -n __fish_use_subcommand -a {} -d {}\n",
                        command.name, in_fish(command.purpose));
  }
  for (const CommandEntry& command : table.commands) {
    const std::string when =
        fmt::format(" -n '__fish_seen_subcommand_from {}'", command.name);
    for (const Argument& option : command.options) {
      text += option_in_fish(option, when, table);
    }
    for (const Argument& argument : command.positionals) {
      text += fmt::format("complete -c trochoid{}{}\n", when,
                          candidates_in_fish(candidates(argument, table)));
    }
  }
  return text;
}

}  // namespace trochoid::cli
