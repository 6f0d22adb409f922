#include <trochoid/cli/interface.h>
#include <trochoid/cli/manual.h>
#include <trochoid/results/provenance.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

namespace trochoid::cli {

namespace {

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

}  // namespace trochoid::cli
