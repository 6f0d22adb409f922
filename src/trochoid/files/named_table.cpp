#include <trochoid/files/named_table.h>

#include <fmt/core.h>

#include <algorithm>

namespace trochoid::files {

namespace {

std::vector<std::optional<TableColumn>> usual_columns(
    std::span<const WantedColumn> wanted, const TableKind& kind,
    const ColumnSearch& search) {
  std::vector<std::optional<TableColumn>> found(wanted.size());
  if (lacks_names(search, kind.example)) return found;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (const auto at = usual_column(search, wanted[i].names)) {
      found[i] = column_at(search, *at, wanted[i].quantity);
    }
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (found[i] || wanted[i].lacking.empty()) continue;
    search.problems.add(search.head.names_line, 1,
                        fmt::format("no column is named {}: the columns are {}",
                                    wanted[i].lacking, all_names(search.head)));
  }
  return found;
}

}  // namespace

NamedTable read_named_table(TableText& table, const FindColumns& find) {
  // The fields of the head are parts of the line of names, which must outlive them.
  const auto first = next_content(table);
  const std::string names = first ? names_row(table, *first) : std::string();
  if (names.empty() && table.problems.lines.empty()) {
    table.problems.add(
        1, 1,
        fmt::format("the file has no data: a row of names, for example {}, and rows "
                    "of numbers are needed",
                    table.kind.example));
  }
  throw_problems(table);
  TableHead head = head_of(table, names);
  std::vector<Field> fields;
  auto line = next_content(table);
  if (line) {
    split(*line, table.separator, fields);
    take_units(table, fields, head);
  }
  NamedTable out;
  const auto columns = find(head, table.problems, out.notes);
  throw_problems(table);
  out.columns.resize(columns.size());
  if (!head.units.empty()) line = next_content(table);
  while (line && !table.problems.full()) {
    split(*line, table.separator, fields);
    if (complete_row(table, fields, head.names.size())) {
      for (std::size_t i = 0; i < columns.size(); ++i) {
        if (!columns[i]) continue;
        out.columns[i].push_back(number_in_row(table, fields, *columns[i]));
      }
      out.lines.push_back(table.lines.number());
    }
    line = next_content(table);
  }
  table.style.check(table.problems);
  throw_problems(table);
  return out;
}

NamedTable read_named_table(TableText& table, std::span<const WantedColumn> wanted) {
  const auto known = [&](std::string_view name) {
    return std::ranges::any_of(wanted, [&](const WantedColumn& column) {
      return std::ranges::find(column.names, name) != column.names.end();
    });
  };
  return read_named_table(table, [&](const TableHead& head, Problems& problems,
                                     std::vector<base::Warning>& notes) {
    return usual_columns(wanted, table.kind,
                         {head, problems, notes, known,
                          "leave out, or rename, the one that is not meant"});
  });
}

void check_increasing(const std::vector<double>& values,
                      const std::vector<std::size_t>& lines, const Increasing& column,
                      Problems& problems) {
  for (std::size_t i = 1; i < values.size() && !problems.full(); ++i) {
    if (values[i] > values[i - 1]) continue;
    problems.add(lines[i], 1,
                 fmt::format("the {0} {1:g} {2} does not come after {3:g} {2}: {0}s "
                             "must increase",
                             column.noun, values[i] / column.factor, column.unit,
                             values[i - 1] / column.factor));
  }
}

}  // namespace trochoid::files
