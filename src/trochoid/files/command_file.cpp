#include <trochoid/base/units.h>
#include <trochoid/files/command_file.h>
#include <trochoid/files/named_table.h>

#include <fmt/core.h>

#include <array>
#include <utility>

namespace trochoid::files {

namespace {

using namespace std::string_view_literals;

constexpr TableKind command_kind{.noun = "a command over the angle",
                                 .files = "a CSV file",
                                 .row = "row",
                                 .example = "angle_deg,command_um"};

constexpr std::array turn_names = {"angle"sv, "phi"sv, "spindleangle"sv};
constexpr std::array command_names = {"command"sv, "setpoint"sv, "reference"sv};

/// Increasing angles over one turn at most; one that closes the turn is left out.
void check_angles(const std::vector<std::size_t>& lines, CommandTable& table,
                  Problems& problems) {
  constexpr double slack = 1e-9;
  check_increasing(table.angle, lines, {"angle", "deg", unit::turn / 360}, problems);
  for (std::size_t i = 1; i < table.angle.size(); ++i) {
    if (table.angle[i] - table.angle.front() <= unit::turn + slack) continue;
    problems.add(lines[i], 1,
                 fmt::format("the angle {:g} deg lies more than a turn after the "
                             "first: one turn is needed, which repeats",
                             table.angle[i] / unit::turn * 360));
    return;
  }
  if (table.angle.size() > 2 &&
      table.angle.back() - table.angle.front() > unit::turn - slack) {
    table.angle.pop_back();
    table.command.pop_back();
  }
}

}  // namespace

CommandTable read_command(std::istream& in, const std::string& name) {
  constexpr std::array wanted = {
      WantedColumn{turn_names, Quantity::angle, "angle, for example angle_deg"},
      WantedColumn{command_names, Quantity::length, "command, for example command_um"}};
  TableText table(in, name, command_kind);
  NamedTable read = read_named_table(table, wanted);
  if (read.lines.size() < 2) {
    table.problems.add(table.lines.number(), 1,
                       fmt::format("the command has {} rows: a whole turn is needed",
                                   read.lines.size()));
  }
  CommandTable out{std::move(read.columns[0]), std::move(read.columns[1])};
  check_angles(read.lines, out, table.problems);
  throw_problems(table);
  return out;
}

CommandTable read_command(const FileRef& file) {
  return read_command(*open_table(file, command_kind), file.path);
}

}  // namespace trochoid::files
