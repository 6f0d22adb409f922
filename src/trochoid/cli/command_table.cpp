#include <trochoid/cli/command_table.h>

#include <CLI/CLI.hpp>

#include <string_view>

namespace trochoid::cli {

namespace {

std::vector<std::string> split(std::string_view text, char by) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t end = text.find(by);
    parts.emplace_back(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return parts;
}

/// TEXT, TEXT:{receptance,mobility} or INT:INT in [1 - 20], as CLI11 writes them.
void read_type(std::string_view type, Argument& argument) {
  const std::size_t colon = type.find(':');
  argument.type = type.substr(0, colon);
  if (colon == std::string_view::npos) {
    return;
  }
  const std::string_view limits = type.substr(colon + 1);
  if (limits.starts_with('{') && limits.ends_with('}')) {
    argument.choices = split(limits.substr(1, limits.size() - 2), ',');
  } else if (const auto open = limits.find('['); open != std::string_view::npos) {
    argument.range = limits.substr(open + 1, limits.rfind(']') - open - 1);
  }
}

Argument read(const CLI::Option& option) {
  Argument argument{.names = {},
                    .type = {},
                    .choices = {},
                    .range = {},
                    .meaning = option.get_description(),
                    .required = option.get_required()};
  if (option.get_positional()) {
    argument.names = {option.get_name(true, false)};
  } else {
    for (const std::string& letter : option.get_snames()) {
      argument.names.push_back("-" + letter);
    }
    for (const std::string& word : option.get_lnames()) {
      argument.names.push_back("--" + word);
    }
  }
  if (option.get_items_expected_max() > 0) {
    read_type(option.get_type_name(), argument);
  }
  return argument;
}

CommandEntry entry(const CLI::App& app) {
  CommandEntry found{.name = app.get_name(),
                     .purpose = app.get_description(),
                     .options = {},
                     .positionals = {}};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) {
      continue;  // hidden
    }
    (option->get_positional() ? found.positionals : found.options)
        .push_back(read(*option));
  }
  return found;
}

}  // namespace

CommandTable command_table(const CLI::App& app) {
  CommandTable table{.program = entry(app), .commands = {}};
  for (const CLI::App* command : app.get_subcommands({})) {
    table.commands.push_back(entry(*command));
  }
  return table;
}

}  // namespace trochoid::cli
