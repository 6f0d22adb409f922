#include <trochoid/files/frf_table.h>

#include <trochoid/files/csv_table.h>

#include <fmt/core.h>

#include <algorithm>
#include <sstream>

namespace trochoid::files {

namespace {

constexpr TableKind frf_rows{.noun = "a frequency response",
                             .files = "a universal file (sets 58) or a table",
                             .row = "line",
                             .example = "freq_Hz,re_m/N,im_m/N",
                             .comments = "#%!*"};

/// Some programs end every row with a separator.
void drop_empty_end(std::vector<Field>& fields) {
  while (!fields.empty() && fields.back().text.empty()) fields.pop_back();
}

bool is_number(const Field& field) {
  const NumberFault fault = parse_number(field.text).fault;
  return fault != NumberFault::not_a_number && fault != NumberFault::missing;
}

/// Settle the separator by a line that it makes numbers only of; false: none does.
bool settle_separator(TableText& text, std::string_view line,
                      std::vector<Field>& fields) {
  for (const char mark : {';', '\t', ',', ' '}) {
    text.separator = mark;
    split_row(text, line, fields);
    drop_empty_end(fields);
    if (fields.size() > 1 && std::all_of(fields.begin(), fields.end(), is_number)) {
      return true;
    }
  }
  return false;
}

void add_row(TableText& text, const std::vector<Field>& fields, FrfTable& table) {
  if (!table.rows.empty() && fields.size() != table.rows.front().size()) {
    text.problems.add(text.lines.number(), 1,
                      fmt::format("the row has {} numbers, the first one {}: every row "
                                  "must be complete",
                                  fields.size(), table.rows.front().size()));
    return;
  }
  std::vector<double> row;
  for (const Field& field : fields) {
    row.push_back(number_in_field(text, field, 1.0, ""));
  }
  table.rows.push_back(std::move(row));
  table.lines.push_back(text.lines.number());
}

/// Keep the names if they go with the numbers below.
void take_names(const TableText& text, const std::string& line, std::size_t columns,
                FrfTable& table) {
  const std::string marks = std::string(text.kind.comments) + ' ';
  const std::size_t shift = std::min(line.find_first_not_of(marks), line.size());
  std::vector<Field> fields;
  split_row(text, std::string_view(line).substr(shift), fields);
  drop_empty_end(fields);
  if (fields.size() != columns) return;
  for (const Field& field : fields) {
    table.names.emplace_back(field.text);
    table.name_columns.push_back(field.column + shift);
  }
}

}  // namespace

FrfTable read_frf_table(const std::string& content, Problems& problems) {
  std::istringstream in(content);
  TableText text(in, problems.file, frf_rows);
  FrfTable table;
  std::vector<Field> fields;
  std::string above;
  bool among_numbers = false;
  while (const auto line = next_line(text)) {
    const bool comment = is_comment(text, *line);
    if (!among_numbers && (comment || !settle_separator(text, *line, fields))) {
      above = std::string(*line);
      table.names_line = text.lines.number();
    } else if (!comment) {
      split_row(text, *line, fields);
      drop_empty_end(fields);
      if (!among_numbers) take_names(text, above, fields.size(), table);
      among_numbers = true;
      add_row(text, fields, table);
    }
    if (text.problems.full()) break;
  }
  text.style.check(text.problems);
  problems.lines = std::move(text.problems.lines);
  if (table.rows.empty() && problems.lines.empty()) {
    problems.add(std::max<std::size_t>(text.lines.number(), 1), 1,
                 "the file has no row of numbers: a universal file with a set 58, or "
                 "a table with, for example, freq_Hz,re_m/N,im_m/N is needed");
  }
  return table;
}

std::optional<std::string> unit_after(std::string_view name,
                                      std::span<const std::string_view> words) {
  const std::string text = small_letters(name);
  for (const std::string_view word : words) {
    if (!text.starts_with(word)) continue;
    const auto rest = name.substr(word.size());
    if (rest.empty()) return std::string();
    if (std::string_view(" _[(/").find(rest.front()) != std::string_view::npos) {
      return std::string(rest.substr(1));
    }
  }
  return std::nullopt;
}

}  // namespace trochoid::files
