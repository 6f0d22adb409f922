#include "sweep_column.h"

#include <trochoid/inputs/csv_table.h>
#include <trochoid/inputs/findings.h>

#include <fmt/core.h>

namespace trochoid::inputs {

namespace {

constexpr TableKind kind{.noun = "a table of cases",
                         .files = "a CSV file",
                         .row = "case",
                         .example = "spindle_rpm,feed_mm"};

}  // namespace

std::vector<double> column_of_file(const std::filesystem::path& file,
                                   std::string_view column,
                                   const std::string& location) {
  std::ifstream in = open_table(file, location, kind);
  TableText table(in, file.string(), kind);
  std::vector<double> values;
  const auto first = next_content(table);
  if (!first) {
    throw_problems(table);
    return values;
  }
  const std::string names = names_row(table, *first);
  const TableHead head = head_of(table, names);
  TableColumn wanted{.index = head.names.size(), .name = std::string(column)};
  std::vector<std::string> known;
  for (std::size_t i = 0; i < head.names.size(); ++i) {
    known.emplace_back(head.names[i].text);
    if (head.names[i].text == column) {
      wanted.index = i;
    }
  }
  if (wanted.index == head.names.size()) {
    table.problems.add(
        head.names_line, 1,
        fmt::format("there is no column \"{}\"{}", column, suggestion(column, known)));
  }
  std::vector<Field> fields;
  while (table.problems.lines.empty()) {
    const auto line = next_content(table);
    if (!line) {
      break;
    }
    split_row(table, *line, fields);
    if (complete_row(table, fields, head.names.size())) {
      values.push_back(number_in_row(table, fields, wanted));
    }
  }
  if (values.empty() && table.problems.lines.empty()) {
    table.problems.add(head.names_line, 1, "there are no rows below the names");
  }
  throw_problems(table);
  return values;
}

}  // namespace trochoid::inputs
