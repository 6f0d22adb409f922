#include <trochoid/base/units.h>
#include <trochoid/inputs/command_file.h>
#include <trochoid/inputs/csv_columns.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace trochoid::inputs {

namespace {

using namespace std::string_view_literals;

constexpr TableKind command_kind{.noun = "a command over the angle",
                                 .files = "a CSV file",
                                 .row = "row",
                                 .example = "angle_deg,command_um"};

constexpr std::array angle_names = {"angle"sv, "phi"sv, "spindleangle"sv};
constexpr std::array command_names = {"command"sv, "setpoint"sv, "reference"sv};

bool is_known_name(std::string_view name) {
  return std::find(angle_names.begin(), angle_names.end(), name) != angle_names.end() ||
         std::find(command_names.begin(), command_names.end(), name) !=
             command_names.end();
}

struct CommandColumns {
  TableColumn angle, command;
};

CommandColumns find_columns(const TableHead& head, Problems& problems) {
  std::vector<base::Warning> notes;  // an angle or a length without its unit is refused
  const ColumnSearch search{head, problems, notes, is_known_name,
                            "leave out, or rename, the one that is not meant"};
  CommandColumns columns;
  if (lacks_names(search, command_kind.example)) {
    return columns;
  }
  const auto find = [&](NameList names, Quantity quantity, std::string_view wanted) {
    if (const auto at = usual_column(search, names)) {
      return column_at(search, *at, quantity);
    }
    problems.add(head.names_line, 1,
                 fmt::format("no column is named {}: the columns are {}", wanted,
                             all_names(head)));
    return TableColumn{};
  };
  columns.angle = find(angle_names, Quantity::angle, "angle, for example angle_deg");
  columns.command =
      find(command_names, Quantity::length, "command, for example command_um");
  return columns;
}

std::vector<std::size_t> read_rows(TableText& table, TableHead& head,
                                   CommandTable& out) {
  std::vector<Field> fields;
  auto line = next_content(table);
  if (line) {
    split(*line, table.separator, fields);
    take_units(table, fields, head);
  }
  const CommandColumns columns = find_columns(head, table.problems);
  throw_problems(table);
  if (!head.units.empty()) {
    line = next_content(table);
  }
  std::vector<std::size_t> lines;
  while (line && !table.problems.full()) {
    split(*line, table.separator, fields);
    if (complete_row(table, fields, head.names.size())) {
      out.angle.push_back(number_in_row(table, fields, columns.angle));
      out.command.push_back(number_in_row(table, fields, columns.command));
      lines.push_back(table.lines.number());
    }
    line = next_content(table);
  }
  return lines;
}

/// Increasing angles over one turn at most; one that closes the turn is left out.
void check_angles(const std::vector<std::size_t>& lines, CommandTable& table,
                  Problems& problems) {
  constexpr double slack = 1e-9;
  for (std::size_t i = 1; i < table.angle.size() && !problems.full(); ++i) {
    const double before = table.angle[i - 1] / unit::turn * 360;
    const double here = table.angle[i] / unit::turn * 360;
    if (here <= before) {
      problems.add(
          lines[i], 1,
          fmt::format("the angle {:g} deg does not come after {:g} deg: angles "
                      "must increase",
                      here, before));
    } else if (table.angle[i] - table.angle.front() > unit::turn + slack) {
      problems.add(lines[i], 1,
                   fmt::format("the angle {:g} deg lies more than a turn after the "
                               "first: one turn is needed, which repeats",
                               here));
      return;
    }
  }
  if (table.angle.size() > 2 &&
      table.angle.back() - table.angle.front() > unit::turn - slack) {
    table.angle.pop_back();
    table.command.pop_back();
  }
}

}  // namespace

CommandTable read_command(std::istream& in, const std::string& name) {
  TableText table(in, name, command_kind);
  const auto first = next_content(table);
  const std::string names = first ? names_row(table, *first) : std::string();
  if (names.empty() && table.problems.lines.empty()) {
    table.problems.add(
        1, 1,
        fmt::format("the file holds no data: a row of names, for example {}, and rows "
                    "of numbers are needed",
                    command_kind.example));
  }
  throw_problems(table);
  TableHead head = head_of(table, names);
  CommandTable out;
  const auto lines = read_rows(table, head, out);
  table.style.check(table.problems);
  throw_problems(table);
  if (lines.size() < 2) {
    table.problems.add(
        table.lines.number(), 1,
        fmt::format("the command has {} rows: a whole turn is needed", lines.size()));
  }
  check_angles(lines, out, table.problems);
  throw_problems(table);
  return out;
}

CommandTable read_command(const ImposedCommand& command) {
  auto in = open_table(command.file, command.location, command_kind);
  return read_command(in, command.file);
}

}  // namespace trochoid::inputs
