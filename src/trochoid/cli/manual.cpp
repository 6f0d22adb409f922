#include <trochoid/cli/manual.h>

#include <trochoid/cli/interface.h>
#include <trochoid/results/provenance.h>

#include <CLI/CLI.hpp>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
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

/// Text as man(7) has it: what it would take for its own is escaped.
std::string roff(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else if (c == '`' || c == '\'') {
      out += c == '`' ? "\\(ga" : "\\(aq";
    } else if (c == '.' && out.empty()) {
      out += "\\&.";
    } else {
      out += c;
    }
  }
  return out;
}

std::string bold(std::string_view text) {
  return fmt::format("\\fB{}\\fR", roff(text));
}

std::string slanted(std::string_view text) {
  return fmt::format("\\fI{}\\fR", roff(text));
}

/// -o, --output FOLDER
std::string heading(const Argument& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) {
    names.push_back(bold(name));
  }
  if (takes_value(option)) {
    names.back() += fmt::format(" {}", slanted(option.type));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string tagged(const std::string& tag, const std::string& text) {
  return fmt::format(".TP\n{}\n{}\n", tag, text);
}

std::string limits(const Argument& argument) {
  if (!argument.choices.empty()) {
    return roff(fmt::format(": {}", fmt::join(argument.choices, ", ")));
  }
  return argument.range.empty() ? "" : roff(fmt::format(" ({})", argument.range));
}

std::string of_command(const CommandEntry& command) {
  std::string text = fmt::format(".SS {} [{}...]", command.name, slanted("OPTION"));
  for (const Argument& argument : command.positionals) {
    const std::string name = slanted(argument.names.front());
    text += argument.required ? fmt::format(" {}", name) : fmt::format(" [{}]", name);
  }
  text += fmt::format("\n{}.\n", roff(command.purpose));
  for (const Argument& argument : command.positionals) {
    text += tagged(slanted(argument.names.front()), roff(argument.meaning));
  }
  std::vector<std::string> names;
  for (const Argument& option : command.options) {
    names.push_back(bold(option.names.back()));
  }
  return text + fmt::format(".PP\nOptions: {}\n", fmt::join(names, ", "));
}

/// Each once, however many commands have it.
std::vector<Argument> different_options(const CommandTable& table) {
  std::vector<Argument> all = table.program.options;
  for (const CommandEntry& command : table.commands) {
    for (const Argument& option : command.options) {
      if (std::find(all.begin(), all.end(), option) == all.end()) {
        all.push_back(option);
      }
    }
  }
  return all;
}

std::string examples() {
  std::string text = ".SH EXAMPLES\n.EX\n";
  for (const std::string_view line : first_steps) {
    text += roff(line) + "\n";
  }
  return text + ".EE\n";
}

std::string exit_status() {
  std::string text = ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : exit_codes) {
    text += tagged(fmt::format("\\fB{}\\fR", code), roff(meaning));
  }
  return text;
}

constexpr std::string_view opening = R"(.SH DESCRIPTION
Computes what the teeth of a milling cutter with runout cut, and turns measured forces,
machined walls and frequency responses into cutting coefficients, runout, modes and limits
of chatter, with how well each is known.
A case file in TOML says tool, cut and measurements; the answer is a folder of tables
with a page to read.
)";

constexpr std::string_view closing = R"(.SH FILES
.TP
\fICASE\fR.toml
The case file.
Every key is listed in \fI\%docs/formats/case.md\fR of the documentation.
.TP
\fICASE\fR.\fICOMMAND\fR/
The answer: \fIsummary.json\fR, tables as CSV, \fIreport.html\fR, and the case as it
was understood.
.SH ENVIRONMENT
.TP
\fBTROCHOID_THREADS\fR
How many threads are used at most, from 1 to 4096; otherwise all of the machine.
Results do not depend on it.
.SH SEE ALSO
\fI\%/usr/share/doc/trochoid/README.md\fR, or \fI\%share/doc/trochoid\fR beside the program.
)";

}  // namespace

CommandTable command_table(const CLI::App& app) {
  CommandTable table{.program = entry(app), .commands = {}};
  for (const CLI::App* command : app.get_subcommands({})) {
    table.commands.push_back(entry(*command));
  }
  return table;
}

std::string man_page(const CommandTable& table) {
  const CommandEntry& program = table.program;
  std::string text = fmt::format(
      ".\\\" Made by `{0} --manual man`.\n"
      ".TH TROCHOID 1 \"\" \"Trochoid {1}\" \"User Commands\"\n"
      ".SH NAME\n"
      "{0} \\- compute what a milling cutter with runout really does\n"
      ".SH SYNOPSIS\n"
      "{2} {3} [{4}...] {5}\n"
      ".br\n"
      "{2} [{6} | {7}]\n",
      program.name, results::version(), bold(program.name), slanted("COMMAND"),
      slanted("OPTION"), slanted("CASE.toml"), bold("--help"), bold("--version"));
  text += opening;
  text += ".SH COMMANDS\n";
  for (const CommandEntry& command : table.commands) {
    text += of_command(command);
  }
  text += ".SH OPTIONS\n";
  for (const Argument& option : different_options(table)) {
    text += tagged(heading(option), roff(option.meaning) + limits(option));
  }
  return text + exit_status() + examples() + std::string(closing);
}

void add_manual(CLI::App& app) {
  app.add_option_function<std::string>(
         "--manual",
         [&app](const std::string& wanted) {
           const CommandTable table = command_table(app);
           const std::string text = wanted == "man"    ? man_page(table)
                                    : wanted == "bash" ? bash_completion(table)
                                    : wanted == "zsh"  ? zsh_completion(table)
                                                       : fish_completion(table);
           fmt::print("{}", text);
           throw CLI::Success();
         },
         "Print the man page, or the completion of a shell")
      ->check(CLI::IsMember({"man", "bash", "zsh", "fish"}))
      ->group("");
}

}  // namespace trochoid::cli
