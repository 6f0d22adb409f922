#include "sweep_column.h"

#include <trochoid/cases/findings.h>
#include <trochoid/files/named_table.h>

#include <fmt/core.h>

namespace trochoid::cases {

namespace {

constexpr files::TableKind kind{.noun = "a table of cases",
                                .files = "a CSV file",
                                .row = "case",
                                .example = "spindle_rpm,feed_mm"};

}  // namespace

std::vector<double> column_of_file(const std::filesystem::path& file,
                                   std::string_view column,
                                   const std::string& location) {
  const auto in = files::open_table(
      {.name = {}, .path = file.generic_string(), .location = location}, kind);
  files::TableText table(*in, file.string(), kind);
  const files::NamedTable read = files::read_named_table(
      table,
      [&](const files::TableHead& head, files::Problems& problems, auto& /*notes*/) {
        std::vector<std::optional<files::TableColumn>> wanted(1);
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
  files::throw_problems(table);
  return read.columns[0];
}

}  // namespace trochoid::cases
