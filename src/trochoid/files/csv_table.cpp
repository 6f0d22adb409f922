#include <fmt/core.h>
#include <trochoid/base/error.h>
#include <trochoid/files/csv_columns.h>
#include <trochoid/files/csv_table.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace trochoid::files {

namespace {

/// Formats that are told apart by how their files begin.
std::string foreign_format(std::string_view begin) {
  const auto starts = [&](std::string_view text) {
    return begin.substr(0, text.size()) == text;
  };
  if (starts("MATLAB ") || starts("\x89HDF")) return "a MATLAB or HDF5 file";
  if (starts("TDSm")) return "a TDMS file";
  if (starts("LabVIEW Measurement")) return "a LabVIEW measurement file";
  if (starts("\xFF\xFE") || starts("\xFE\xFF")) return "UTF-16 text";
  if (starts("PK\x03\x04")) return "a packed file, perhaps a spreadsheet";
  return {};
}

std::string fault_text(NumberFault fault, std::string_view row) {
  switch (fault) {
    case NumberFault::missing:
      return "the value is missing: every column needs a number in every row";
    case NumberFault::not_finite:
      return fmt::format("is not a finite number: leave out or repair the {}", row);
    case NumberFault::out_of_range:
      return "is too large or too small for a number";
    default:
      return "is not a number";
  }
}

}  // namespace

std::unique_ptr<std::istream> open_table(const FileRef& file, const TableKind& kind) {
  if (file.bytes) return std::make_unique<std::istringstream>(*file.bytes);
  const std::string& name = file.path;
  const auto where = file.location.empty() ? name + ":1:1" : file.location;
  const auto refuse = [&](const std::string& why) {
    throw base::InputError({fmt::format("{}: file = {}: {}", where, name, why)});
  };
  std::error_code error;
  const auto status = std::filesystem::status(name, error);
  if (!std::filesystem::exists(status)) refuse("there is no such file");
  if (!std::filesystem::is_regular_file(status)) {
    refuse(fmt::format("this is no regular file: name {}", kind.files));
  }
  auto in = std::make_unique<std::ifstream>(name, std::ios::binary);
  if (!*in) refuse("the file cannot be opened for reading");
  const bool empty = in->peek() == std::ifstream::traits_type::eof();
  if (in->bad()) refuse("the file cannot be read");
  if (empty) {
    throw base::InputError({fmt::format(
        "{}:1:1: the file is empty: a row of names, for example {}, and rows of "
        "numbers are needed",
        name, kind.example)});
  }
  return in;
}

std::string bytes_of(const FileRef& file, const TableKind& kind) {
  if (file.bytes) return *file.bytes;
  return {std::istreambuf_iterator<char>(*open_table(file, kind)), {}};
}

std::optional<std::string_view> next_line(TableText& table) {
  while (auto line = table.lines.next()) {
    if (table.lines.number() == 1 && line->substr(0, 3) == "\xEF\xBB\xBF") {
      line->remove_prefix(3);
    }
    if (table.lines.number() == 1) {
      const bool expected =
          !table.kind.begins.empty() && line->starts_with(table.kind.begins);
      const auto foreign = expected ? std::string() : foreign_format(*line);
      if (!foreign.empty()) {
        table.problems.add(1, 1,
                           fmt::format("this is {}, which is not read here: export it "
                                       "as CSV text in UTF-8",
                                       foreign));
        return std::nullopt;
      }
    }
    if (const auto at = control_character(*line)) {
      table.problems.add(
          table.lines.number(), *at,
          fmt::format("byte 0x{:02X} does not belong into a text: {} is {}",
                      static_cast<unsigned char>((*line)[*at - 1]), table.kind.noun,
                      table.kind.files));
      return std::nullopt;
    }
    if (line->find_first_not_of(" \t") != std::string_view::npos) return line;
  }
  if (table.lines.too_long()) {
    table.problems.add(
        table.lines.number(), LineReader::longest + 1,
        fmt::format("the line is longer than {} bytes: {} has one {} a line",
                    LineReader::longest, table.kind.noun, table.kind.row));
  }
  return std::nullopt;
}

bool is_comment(const TableText& table, std::string_view line) noexcept {
  const char first = line[line.find_first_not_of(" \t")];
  return table.kind.comments.find(first) != std::string_view::npos;
}

std::optional<std::string_view> next_content(TableText& table) {
  auto line = next_line(table);
  while (line && is_comment(table, *line)) {
    line = next_line(table);
  }
  return line;
}

void split_row(const TableText& table, std::string_view line,
               std::vector<Field>& fields) {
  if (table.separator != ' ') {
    split(line, table.separator, fields);
    return;
  }
  fields.clear();
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t", at)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    fields.push_back({line.substr(at, end - at), at + 1});
    at = end;
  }
}

std::string names_row(TableText& table, std::string_view line) {
  if (line.size() == 5 && line.substr(0, 4) == "sep=") {  // as spreadsheets write
    table.separator = line[4];
    const auto next = next_content(table);
    return next ? std::string(*next) : std::string();
  }
  for (const char mark : {';', '\t', ','}) {
    if (line.find(mark) != std::string_view::npos) {
      table.separator = mark;
      break;
    }
  }
  return std::string(line);
}

TableHead head_of(const TableText& table, std::string_view names) {
  TableHead head;
  head.names_line = table.lines.number();
  split(names, table.separator, head.names);
  if (head.names.back().text.empty()) head.names.pop_back();
  return head;
}

void take_units(TableText& table, const std::vector<Field>& fields, TableHead& head) {
  if (!is_unit_row(fields)) return;
  head.units = fields;
  head.units_line = table.lines.number();
  if (head.units.size() == head.names.size() + 1 && head.units.back().text.empty()) {
    head.units.pop_back();
  }
  if (head.units.size() != head.names.size()) {
    table.problems.add(head.units_line, 1,
                       fmt::format("the row of units has {} fields, the row of names "
                                   "{}: every column needs its unit",
                                   head.units.size(), head.names.size()));
    head.units.resize(std::min(head.units.size(), head.names.size()));
  }
}

bool complete_row(TableText& table, std::vector<Field>& fields, std::size_t count) {
  // Some programs end every row with a separator.
  if (fields.size() == count + 1 && fields.back().text.empty()) {
    fields.pop_back();
  }
  if (fields.size() == count) return true;
  const bool commas = table.separator == ',' && fields.size() == 2 * count;
  table.problems.add(
      table.lines.number(), 1,
      fmt::format("the row has {} fields, the row of names {}{}", fields.size(), count,
                  commas ? ": with decimal commas the columns must be separated by ; "
                           "or a tab"
                         : ": every row must be complete"));
  return false;
}

double number_in_field(TableText& table, const Field& field, double factor,
                       std::string_view name) {
  Number number = parse_number(field.text);
  const auto line = table.lines.number();
  if (number.fault == NumberFault::none && !std::isfinite(number.value * factor)) {
    number.fault = NumberFault::out_of_range;
  }
  if (number.fault == NumberFault::none) {
    table.style.see(field.text, line, field.column);
    return number.value * factor;
  }
  const auto what =
      number.fault == NumberFault::missing ? std::string() : excerpt(field.text) + ' ';
  table.problems.add(
      line, field.column,
      fmt::format("{}{}{}",
                  name.empty() ? "" : fmt::format("column {}: ", excerpt(name)), what,
                  fault_text(number.fault, table.kind.row)));
  return 0.0;
}

double number_in_row(TableText& table, const std::vector<Field>& fields,
                     const TableColumn& column) {
  return number_in_field(table, fields[column.index], column.factor, column.name);
}

void throw_problems(const TableText& table) {
  if (!table.problems.lines.empty()) {
    throw base::InputError(table.problems.lines);
  }
}

}  // namespace trochoid::files
