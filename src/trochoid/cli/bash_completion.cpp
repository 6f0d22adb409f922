#include <trochoid/cli/completion.h>
#include <trochoid/cli/manual.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <string_view>

namespace trochoid::cli {

namespace {

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

}  // namespace trochoid::cli
