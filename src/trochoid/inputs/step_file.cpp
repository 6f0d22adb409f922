#include <trochoid/inputs/csv_columns.h>
#include <trochoid/inputs/step_file.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace trochoid::inputs {

namespace {

using namespace std::string_view_literals;

constexpr TableKind step_kind{.noun = "the record of a step",
                              .files = "a CSV file",
                              .row = "sample",
                              .example = "time_s,command_um,position_um"};

constexpr std::array time_names = {"time"sv, "t"sv};
constexpr std::array command_names = {"command"sv, "setpoint"sv, "reference"sv};
constexpr std::array position_names = {"position"sv, "displacement"sv, "response"sv};
constexpr std::array<NameList, 3> all_lists = {time_names, command_names,
                                               position_names};

bool is_known_name(std::string_view name) {
  return std::any_of(all_lists.begin(), all_lists.end(), [&](const NameList& list) {
    return std::find(list.begin(), list.end(), name) != list.end();
  });
}

struct StepColumns {
  std::optional<TableColumn> time, command, position;
};

StepColumns find_columns(const TableHead& head, const StepSource& source, StepFile& out,
                         Problems& problems) {
  const ColumnSearch search{head, problems, out.notes, is_known_name,
                            "leave out, or rename, the one that is not meant"};
  StepColumns columns;
  if (lacks_names(search, step_kind.example)) return columns;
  const auto found = [&](NameList names, Quantity quantity) {
    const auto at = usual_column(search, names);
    return at ? std::optional(column_at(search, *at, quantity)) : std::nullopt;
  };
  columns.time = found(time_names, Quantity::time);
  columns.command = found(command_names, Quantity::length);
  columns.position = found(position_names, Quantity::length);
  const auto lacks = [&](std::string_view wanted) {
    problems.add(head.names_line, 1,
                 fmt::format("no column is named {}: the columns are {}", wanted,
                             all_names(head)));
  };
  if (!columns.time) lacks("time, for example time_s");
  if (!columns.position) lacks("position, for example position_um");
  if (!columns.command && !source.step) {
    lacks(
        "command, for example command_um, and no height of the step is given "
        "(--step-um, or step_um in [step])");
  }
  return columns;
}

/// Where the command changes, and by how much.
void settle_command(const StepSource& source, std::size_t last_line, StepFile& out,
                    Problems& problems) {
  auto& record = out.record;
  record.start = source.start;
  if (source.step) record.step = *source.step;
  if (out.command.empty()) return;
  const double first = out.command.front();
  const double last = out.command.back();
  const double height = last - first;
  if (height == 0) {
    problems.add(
        last_line, 1,
        "the command is the same at the end as at the beginning: one step from "
        "one value to another is needed");
    return;
  }
  std::size_t before = 0;
  std::size_t after = out.command.size() - 1;
  const double slack = 1e-3 * std::abs(height);
  while (std::abs(out.command[before + 1] - first) <= slack) ++before;
  while (std::abs(out.command[after - 1] - last) <= slack) --after;
  if (after != before + 1) {
    problems.add(1, 1,
                 fmt::format("the command is no step: it leaves its first value after "
                             "{:g} s and reaches its last one at {:g} s",
                             record.time[before], record.time[after]));
    return;
  }
  record.change = {record.time[before], record.time[after]};
  if (!source.step) {
    record.step = height;
  } else if (std::abs(*source.step - height) > slack) {
    problems.add(1, 1,
                 fmt::format("the command steps by {:g} um, but step_um = {:g}: they "
                             "must agree",
                             height * 1e6, *source.step * 1e6));
  }
}

void check_time(const std::vector<double>& time, const std::vector<std::size_t>& lines,
                Problems& problems) {
  for (std::size_t i = 1; i < time.size() && !problems.full(); ++i) {
    if (time[i] <= time[i - 1]) {
      problems.add(lines[i], 1,
                   fmt::format("the time {:g} s does not come after "
                               "{:g} s: times must increase",
                               time[i], time[i - 1]));
    }
  }
}

std::vector<std::size_t> read_rows(TableText& table, TableHead& head,
                                   const StepSource& source, StepFile& out) {
  std::vector<Field> fields;
  auto line = next_content(table);
  if (line) {
    split(*line, table.separator, fields);
    take_units(table, fields, head);
  }
  const StepColumns columns = find_columns(head, source, out, table.problems);
  throw_problems(table);
  if (!head.units.empty()) line = next_content(table);
  std::vector<std::size_t> lines;
  while (line && !table.problems.full()) {
    split(*line, table.separator, fields);
    if (complete_row(table, fields, head.names.size())) {
      out.record.time.push_back(number_in_row(table, fields, *columns.time));
      out.record.position.push_back(number_in_row(table, fields, *columns.position));
      if (columns.command) {
        out.command.push_back(number_in_row(table, fields, *columns.command));
      }
      lines.push_back(table.lines.number());
    }
    line = next_content(table);
  }
  return lines;
}

}  // namespace

StepFile read_step(std::istream& in, const std::string& name,
                   const StepSource& source) {
  TableText table(in, name, step_kind);
  const auto first = next_content(table);
  const std::string names = first ? names_row(table, *first) : std::string();
  if (names.empty() && table.problems.lines.empty()) {
    table.problems.add(
        1, 1,
        fmt::format("the file holds no data: a row of names, for example "
                    "{}, and rows of numbers are needed",
                    step_kind.example));
  }
  throw_problems(table);
  TableHead head = head_of(table, names);
  StepFile out;
  const auto lines = read_rows(table, head, source, out);
  table.style.check(table.problems);
  throw_problems(table);
  if (lines.size() < 2) {
    table.problems.add(
        table.lines.number(), 1,
        fmt::format("the record has {} samples: a whole step is needed", lines.size()));
    throw_problems(table);
  }
  check_time(out.record.time, lines, table.problems);
  settle_command(source, lines.back(), out, table.problems);
  throw_problems(table);
  return out;
}

StepFile read_step(const StepSource& source) {
  const std::string name = source.file.generic_string();
  if (source.content) {
    std::istringstream in(*source.content);
    return read_step(in, name, source);
  }
  auto in = open_table(source.file, source.location, step_kind);
  return read_step(in, name, source);
}

}  // namespace trochoid::inputs
