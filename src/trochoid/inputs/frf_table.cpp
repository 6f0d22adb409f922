#include <trochoid/inputs/frf_table.h>

#include <fmt/core.h>

#include <sstream>

namespace trochoid::inputs {

namespace {

constexpr std::string_view comment_marks = "#%!*";

std::vector<Field> blank_separated(std::string_view line) {
  std::vector<Field> fields;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t", at)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    fields.push_back({line.substr(at, end - at), at + 1});
    at = end;
  }
  return fields;
}

/// Blanks are a separator of their own: ' '.
std::vector<Field> fields_of(std::string_view line, char separator) {
  if (separator == ' ') return blank_separated(line);
  std::vector<Field> fields;
  split(line, separator, fields);
  while (!fields.empty() && fields.back().text.empty()) fields.pop_back();
  return fields;
}

bool is_number(const Field& field) {
  return parse_number(field.text).fault != NumberFault::not_a_number &&
         parse_number(field.text).fault != NumberFault::missing;
}

/// The separator that makes of a line numbers only; 0: none does.
char separator_of(std::string_view line) {
  for (const char mark : {';', '\t', ',', ' '}) {
    const auto fields = fields_of(line, mark);
    bool numbers = fields.size() > 1;
    for (const Field& field : fields) {
      numbers = numbers && is_number(field);
    }
    if (numbers) return mark;
  }
  return 0;
}

void add_row(const std::vector<Field>& fields, std::size_t line, DecimalStyle& style,
             FrfTable& table, Problems& problems) {
  if (!table.rows.empty() && fields.size() != table.rows.front().size()) {
    problems.add(line, 1,
                 fmt::format("the row has {} numbers, the first one {}: every row must "
                             "be complete",
                             fields.size(), table.rows.front().size()));
    return;
  }
  std::vector<double> row;
  for (const Field& field : fields) {
    const Number number = parse_number(field.text);
    row.push_back(number.value);
    if (number.fault == NumberFault::none) {
      style.see(field.text, line, field.column);
      continue;
    }
    problems.add(
        line, field.column,
        fmt::format("{}: {}", excerpt(field.text),
                    number.fault == NumberFault::not_a_number ? "not a number"
                    : number.fault == NumberFault::missing    ? "the value is missing"
                                                              : "not a finite number"));
  }
  table.rows.push_back(std::move(row));
  table.lines.push_back(line);
}

/// Keep the names if they go with the numbers below.
void take_names(const std::string& line, char separator, std::size_t columns,
                FrfTable& table) {
  std::string_view rest = line;
  std::size_t shift = 0;
  while (!rest.empty() && (comment_marks.find(rest.front()) != std::string_view::npos ||
                           rest.front() == ' ')) {
    rest.remove_prefix(1);
    ++shift;
  }
  const auto fields = fields_of(rest, separator);
  if (fields.size() != columns) return;
  for (const Field& field : fields) {
    table.names.emplace_back(field.text);
    table.name_columns.push_back(field.column + shift);
  }
}

}  // namespace

FrfTable read_frf_table(const std::string& text, Problems& problems) {
  std::istringstream in(text);
  LineReader lines(in);
  FrfTable table;
  DecimalStyle style;
  std::string above;
  char separator = 0;
  while (auto line = lines.next()) {
    if (lines.number() == 1 && line->substr(0, 3) == "\xEF\xBB\xBF") {
      line->remove_prefix(3);
    }
    if (const auto at = control_character(*line)) {
      problems.add(lines.number(), *at,
                   fmt::format("byte 0x{:02X} does not belong into a text: a frequency "
                               "response is a universal file (sets 58) or a table",
                               static_cast<unsigned char>((*line)[*at - 1])));
      return table;
    }
    const auto first = line->find_first_not_of(" \t");
    if (first == std::string_view::npos) continue;
    const bool comment = comment_marks.find((*line)[first]) != std::string_view::npos;
    if (separator == 0 && !comment) separator = separator_of(*line);
    if (separator == 0) {
      above = std::string(*line);
      table.names_line = lines.number();
    } else if (!comment) {
      const auto fields = fields_of(*line, separator);
      if (table.rows.empty()) take_names(above, separator, fields.size(), table);
      add_row(fields, lines.number(), style, table, problems);
    }
    if (problems.full()) return table;
  }
  if (lines.too_long()) {
    problems.add(lines.number(), LineReader::longest + 1,
                 "the line is too long: a table has one row a line");
  }
  style.check(problems);
  if (table.rows.empty() && problems.lines.empty()) {
    problems.add(std::max<std::size_t>(lines.number(), 1), 1,
                 "the file holds no row of numbers: a universal file with a set 58, or "
                 "a table with, for example, freq_Hz,re_m/N,im_m/N is needed");
  }
  return table;
}

}  // namespace trochoid::inputs
