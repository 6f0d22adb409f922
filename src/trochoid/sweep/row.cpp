#include <trochoid/sweep/row.h>

#include <trochoid/base/error.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/run/answer.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

namespace trochoid::sweep {

namespace {

using results::Answer;
using results::Array;
using results::Cell;
using results::Object;
using results::Value;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::optional<Cell> cell_of(const Value& value) {
  if (const auto* real = std::get_if<double>(&value.data)) {
    return std::isfinite(*real) ? *real : none;
  }
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) {
    return static_cast<double>(*whole);
  }
  if (const auto* truth = std::get_if<bool>(&value.data)) {
    return *truth ? 1.0 : 0.0;
  }
  if (const auto* text = std::get_if<std::string>(&value.data)) {
    return *text;
  }
  return std::holds_alternative<std::nullptr_t>(value.data) ? std::optional<Cell>(none)
                                                            : std::nullopt;
}

Cell cell_of(const cases::Node& node) {
  if (const auto* real = std::get_if<double>(&node.value)) {
    return *real;
  }
  if (const auto* whole = std::get_if<std::int64_t>(&node.value)) {
    return static_cast<double>(*whole);
  }
  if (const auto* truth = std::get_if<bool>(&node.value)) {
    return *truth ? 1.0 : 0.0;
  }
  return std::get<std::string>(node.value);
}

/// As a file of rows holds them, so that rows read from it are the same.
void put_on_one_line(results::SweepRow& row) {
  const auto join = [](std::string& text) {
    std::ranges::replace_if(
        text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  };
  for (Cell& cell : row.cells) {
    if (auto* text = std::get_if<std::string>(&cell)) {
      join(*text);
    }
  }
  join(row.message);
}

const Value* entry_of(const Value& list, std::string_view number) {
  const auto* array = std::get_if<Array>(&list.data);
  std::size_t i = 0;
  const char* end = number.data() + number.size();
  const auto read = std::from_chars(number.data(), end, i);
  return array != nullptr && read.ec == std::errc{} && read.ptr == end && i > 0 &&
                 i <= array->size()
             ? &(*array)[i - 1]
             : nullptr;
}

/// `a.b[2][1]` -> a, b, 2], 1]: names, and entries with their closing bracket.
std::vector<std::string> steps_of(std::string_view path) {
  std::vector<std::string> steps(1);
  for (const char c : path) {
    if (c == '.' || c == '[') {
      steps.emplace_back();
    } else {
      steps.back() += c;
    }
  }
  return steps;
}

void add_paths(const Value& value, const std::string& path,
               std::vector<std::string>& paths) {
  if (const auto* object = std::get_if<Object>(&value.data)) {
    for (const results::Member& member : *object) {
      add_paths(member.value, path + "." + member.key, paths);
    }
  } else if (const auto* list = std::get_if<Array>(&value.data)) {
    for (std::size_t i = 0; i < list->size(); ++i) {
      add_paths((*list)[i], path + "[" + std::to_string(i + 1) + "]", paths);
    }
  } else {
    paths.push_back(path);
  }
}

/// Whether records are needed: with what they say a prediction is compared, which takes
/// longer than the prediction, and only who takes that from it needs them.
bool compares(const Study& study) {
  return study.command != base::Command::simulate ||
         std::ranges::any_of(study.take, [](const std::string& path) {
           return path.starts_with("result.comparison");
         });
}

}  // namespace

std::optional<Cell> taken(const Answer& answer, std::string_view path) {
  constexpr std::string_view top = "result.";
  if (!path.starts_with(top)) {
    return std::nullopt;
  }
  path.remove_prefix(top.size());
  const Value* at = &answer.result;
  for (const std::string& step : steps_of(path)) {
    if (at == nullptr) {
      break;
    }
    at = step.ends_with(']')
             ? entry_of(*at, std::string_view(step).substr(0, step.size() - 1))
             : find(*at, step);
  }
  return at == nullptr ? std::nullopt : cell_of(*at);
}

std::vector<std::string> paths_of(const Answer& answer) {
  std::vector<std::string> paths;
  add_paths(answer.result, "result", paths);
  return paths;
}

cases::Node root_of(const Study& study, std::span<const cases::Node> values) {
  cases::Node root = study.root;
  for (std::size_t k = 0; k < values.size(); ++k) {
    set_key(root, study.over[k], values[k]);
  }
  return root;
}

cases::CaseSource source_of(const Study& study, const cases::Node& root) {
  return {root, study.file, study.data, study.base};
}

results::SweepRow row_of(const Study& study, std::span<const cases::Node> values) {
  results::SweepRow row{.cells = {}, .status = "ok", .message = {}};
  for (const cases::Node& value : values) {
    row.cells.push_back(cell_of(value));
  }
  row.cells.resize(values.size() + study.take.size(), none);
  try {
    const cases::Node root = root_of(study, values);
    cases::CaseSource source = source_of(study, root);
    source.echo = false;
    cases::Case given = cases::read_case(source, study.command);
    if (!compares(study)) {
      given.measurements.clear();
    }
    const Answer found = run::answer(study.command, given, {.tables = false});
    if (!found.heading.ok) {
      row.status = "failed";
      row.message = found.heading.message;
    } else {
      for (std::size_t i = 0; i < study.take.size(); ++i) {
        row.cells[values.size() + i] = taken(found, study.take[i]).value_or(Cell{none});
      }
    }
  } catch (const base::InputError& error) {
    row.status = "wrong_input";
    row.message = error.problems().empty() ? error.what() : error.problems().front();
  }
  put_on_one_line(row);
  return row;
}

std::vector<results::SweepRow> rows(
    const Study& study, std::size_t count,
    const std::function<std::vector<cases::Node>(std::size_t)>& values) {
  std::vector<results::SweepRow> rows(count);
  numerics::for_each_index(
      count, [&](std::size_t i) { rows[i] = row_of(study, values(i)); }, 1);
  return rows;
}

}  // namespace trochoid::sweep
