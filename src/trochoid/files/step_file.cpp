#include <trochoid/files/named_table.h>
#include <trochoid/files/step_file.h>

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <utility>

namespace trochoid::files {

namespace {

using namespace std::string_view_literals;

constexpr TableKind step_kind{.noun = "the record of a step",
                              .files = "a CSV file",
                              .row = "sample",
                              .example = "time_s,command_um,position_um"};

constexpr std::array step_time_names = {"time"sv, "t"sv};
constexpr std::array step_command_names = {"command"sv, "setpoint"sv, "reference"sv};
constexpr std::array step_position_names = {"position"sv, "displacement"sv,
                                            "response"sv};
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

}  // namespace

StepFile read_step(std::istream& in, const std::string& name,
                   const StepSource& source) {
  const std::array wanted = {
      WantedColumn{step_time_names, Quantity::time, "time, for example time_s"},
      WantedColumn{step_position_names, Quantity::length,
                   "position, for example position_um"},
      WantedColumn{step_command_names, Quantity::length,
                   source.step
                       ? ""
                       : "command, for example command_um, and no height of the step "
                         "is given (--step-um, or step_um in [step])"}};
  TableText table(in, name, step_kind);
  NamedTable read = read_named_table(table, wanted);
  const auto& lines = read.lines;
  if (lines.size() < 2) {
    table.problems.add(
        table.lines.number(), 1,
        fmt::format("the record has {} samples: a whole step is needed", lines.size()));
    throw_problems(table);
  }
  StepFile out{.command = std::move(read.columns[2]), .notes = std::move(read.notes)};
  out.record.time = std::move(read.columns[0]);
  out.record.position = std::move(read.columns[1]);
  check_increasing(out.record.time, lines, {"time", "s"}, table.problems);
  settle_command(source, lines.back(), out, table.problems);
  throw_problems(table);
  return out;
}

StepFile read_step(const StepSource& source) {
  return read_step(*open_table(source.file, step_kind), source.file.path, source);
}

}  // namespace trochoid::files
