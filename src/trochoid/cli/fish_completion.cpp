#include <trochoid/cli/completion.h>
#include <trochoid/cli/manual.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <string_view>

namespace trochoid::cli {

namespace {

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
