#include <trochoid/files/named_table.h>
#include <trochoid/files/step_file.h>
#include <trochoid/numerics/median.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
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

/// A change of the command from one level to another.
struct CommandStep {
  std::size_t before = 0;  ///< last sample of the old level
  std::size_t after = 0;   ///< first sample of the new one
  double height = 0.0;     ///< [m]
};

/// Of the range of a command, below which a change is none.
constexpr double least_change = 1e-3;
/// A command that was recorded scatters: so many times what nine of ten samples differ by
/// from the one before.
constexpr double above_scatter = 4.0;
/// Fewer samples show no scatter.
constexpr std::size_t samples_with_scatter = 20;
/// A filter before a converter spreads a step over some samples: no more than a hundredth
/// of the record, and than these.
constexpr std::size_t longest_change = 3;
/// Steps within this fraction of the highest are as high.
constexpr double as_high = 0.95;
/// Of the level before a step, where an earlier step has died out.
constexpr std::size_t part_at_rest = 10;

double middle_of(std::span<const double> values) {
  return numerics::median({values.begin(), values.end()});
}

/// What two samples of one level may differ by.
double slack_of(const std::vector<double>& command) {
  const auto [least, most] = std::ranges::minmax(command);
  const double slack = least_change * (most - least);
  if (command.size() < samples_with_scatter) return slack;
  std::vector<double> steps;
  for (std::size_t i = 1; i < command.size(); ++i) {
    steps.push_back(std::abs(command[i] - command[i - 1]));
  }
  return slack + above_scatter * numerics::value_at_rank(steps, 9 * steps.size() / 10);
}

/// The steps of a command; empty: it is not made of steps.
std::vector<CommandStep> steps_of(const std::vector<double>& command) {
  const double slack = slack_of(command);
  const std::size_t n = command.size();
  const std::size_t longest = std::clamp<std::size_t>(n / 100, 1, longest_change);
  std::vector<CommandStep> steps;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (std::abs(command[i + 1] - command[i]) <= slack) continue;
    CommandStep step{.before = i, .after = i + 1};
    while (step.after + 1 < n &&
           std::abs(command[step.after + 1] - command[step.after]) > slack) {
      ++step.after;
    }
    if (step.after - step.before > longest) return {};
    i = step.after - 1;
    steps.push_back(step);
  }
  double level = 0.0;
  for (std::size_t k = 0; k <= steps.size(); ++k) {
    const std::size_t from = k == 0 ? 0 : steps[k - 1].after;
    const std::size_t end = k == steps.size() ? n : steps[k].before + 1;
    const std::span<const double> flat = std::span(command).subspan(from, end - from);
    const double own = middle_of(flat);
    if (std::ranges::any_of(
            flat, [&](double value) { return std::abs(value - own) > 1.5 * slack; })) {
      return {};
    }
    if (k > 0) steps[k - 1].height = own - level;
    level = own;
  }
  return steps;
}

/// Which of several steps is meant: the one that starts where it was said, or the first
/// of the highest.
std::size_t meant(const std::vector<CommandStep>& steps, const StepFile& file,
                  const std::optional<double>& start) {
  const auto away = [&](const CommandStep& step) {
    return std::abs(file.record.time[step.before] - *start);
  };
  double highest = 0.0;
  for (const CommandStep& step : steps) {
    highest = std::max(highest, std::abs(step.height));
  }
  const auto found = start ? std::ranges::min_element(steps, {}, away)
                           : std::ranges::find_if(steps, [&](const CommandStep& step) {
                               return std::abs(step.height) >= as_high * highest;
                             });
  return static_cast<std::size_t>(found - steps.begin());
}

template <class T>
void keep(std::vector<T>& values, std::size_t from, std::size_t end) {
  values.erase(values.begin() + static_cast<std::ptrdiff_t>(end), values.end());
  values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(from));
}

/// Keep of a record with several steps what belongs to one, and say so.
CommandStep only(const std::vector<CommandStep>& steps, std::size_t k, StepFile& out) {
  CommandStep step = steps[k];
  const std::size_t since = k == 0 ? 0 : steps[k - 1].after;
  const std::size_t rest = (step.before + 1 - since) / part_at_rest + 1;
  const std::size_t from = k == 0 ? 0 : step.before + 1 - rest;
  const std::size_t end =
      k + 1 < steps.size() ? steps[k + 1].before + 1 : out.command.size();
  out.notes.push_back(
      {"several_steps",
       fmt::format(
           "The command has {} steps: the one of {:.4g} um at {:g} s was taken, up "
           "to the next one. `start_s` chooses another.",
           steps.size(), step.height * 1e6, out.record.time[step.after])});
  keep(out.command, from, end);
  keep(out.record.time, from, end);
  keep(out.record.position, from, end);
  step.before -= from;
  step.after -= from;
  return step;
}

void no_step(const StepFile& out, std::size_t last_line, Problems& problems) {
  const std::vector<double>& c = out.command;
  const double slack = slack_of(c);
  std::size_t before = 0;
  std::size_t after = c.size() - 1;
  while (before + 1 < c.size() && std::abs(c[before + 1] - c.front()) <= slack)
    ++before;
  while (after > 0 && std::abs(c[after - 1] - c.back()) <= slack) --after;
  if (std::abs(c.back() - c.front()) <= slack && before + 1 == c.size()) {
    problems.add(
        last_line, 1,
        "the command is the same at the end as at the beginning: one step from "
        "one value to another is needed");
    return;
  }
  problems.add(1, 1,
               fmt::format("the command is no step: it leaves its first value after "
                           "{:g} s and reaches its last one at {:g} s",
                           out.record.time[before], out.record.time[after]));
}

/// Where the command changes, and by how much.
void settle_command(const StepSource& source, std::size_t last_line, StepFile& out,
                    Problems& problems) {
  auto& record = out.record;
  record.start = source.start;
  if (source.step) record.step = *source.step;
  if (out.command.empty()) return;
  const std::vector<CommandStep> steps = steps_of(out.command);
  if (steps.empty()) {
    no_step(out, last_line, problems);
    return;
  }
  CommandStep step = steps.front();
  if (steps.size() > 1) {
    step = only(steps, meant(steps, out, source.start), out);
  }
  record.change = {record.time[step.before], record.time[step.after]};
  const double slack =
      std::max(least_change * std::abs(step.height), slack_of(out.command));
  if (!source.step) {
    record.step = step.height;
  } else if (std::abs(*source.step - step.height) > slack) {
    problems.add(1, 1,
                 fmt::format("the command steps by {:g} um, but step_um = {:g}: they "
                             "must agree",
                             step.height * 1e6, *source.step * 1e6));
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
