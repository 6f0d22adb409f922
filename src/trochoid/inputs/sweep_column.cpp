#include "sweep_column.h"

#include <trochoid/inputs/findings.h>
#include <trochoid/inputs/named_table.h>

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
  const auto in = open_table(
      {.name = {}, .path = file.generic_string(), .location = location}, kind);
  TableText table(*in, file.string(), kind);
  const NamedTable read = read_named_table(
      table, [&](const TableHead& head, Problems& problems, auto& /*notes*/) {
        std::vector<std::optional<TableColumn>> wanted(1);
        std::vector<std::string> known;
        for (std::size_t i = 0; i < head.names.size(); ++i) {
          known.emplace_back(head.names[i].text);
          if (known.back() == column) wanted[0] = {.index = i, .name = known.back()};
        }
        if (!wanted[0]) {
          problems.add(head.names_line, 1,
                       fmt::format("there is no column \"{}\"{}", column,
                                   suggestion(column, known)));
        }
        return wanted;
      });
  if (read.lines.empty()) {
    table.problems.add(table.lines.number(), 1, "there are no rows below the names");
  }
  throw_problems(table);
  return read.columns[0];
}

}  // namespace trochoid::inputs
