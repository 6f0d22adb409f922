#include <trochoid/sweep/part_text.h>

#include <trochoid/results/csv_cells.h>
#include <trochoid/results/number.h>

#include <fmt/core.h>

#include <charconv>
#include <limits>
#include <sstream>

namespace trochoid::sweep {

namespace {

using results::Cell;
using results::SweepRow;

std::string line_of(const SweepRow& row) {
  std::string line;
  for (const Cell& cell : row.cells) {
    if (const auto* value = std::get_if<double>(&cell)) {
      results::append_number(line, *value);
    } else {
      results::append_quoted(line, std::get<std::string>(cell));
    }
    line += ',';
  }
  results::append_quoted(line, row.status);
  line += ',';
  results::append_quoted(line, row.message);
  return line + '\n';
}

Cell cell_of(std::string_view text) {
  if (text.starts_with('"')) {
    return results::unquoted(text);
  }
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

SweepRow row_of(std::string_view line, std::size_t cells) {
  SweepRow row;
  for (std::size_t i = 0; i < cells; ++i) {
    row.cells.push_back(cell_of(results::cut_cell(line)));
  }
  row.status = results::unquoted(results::cut_cell(line));
  row.message = results::unquoted(results::cut_cell(line));
  return row;
}

}  // namespace

std::uint64_t checksum(std::string_view text) noexcept {
  std::uint64_t sum = 0xcbf29ce484222325U;
  for (const char c : text) {
    sum = (sum ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  }
  return sum;
}

bool whole_line(std::istream& in, std::string& line) {
  return std::getline(in, line) && !in.eof();
}

std::string part_text(std::size_t first, std::span<const SweepRow> rows) {
  std::string text;
  for (const SweepRow& row : rows) {
    text += line_of(row);
  }
  return fmt::format("{} {} {:016x}\n", first, rows.size(), checksum(text)) + text;
}

std::optional<std::vector<SweepRow>> read_part(std::istream& in, std::size_t first,
                                               std::size_t cells) {
  std::size_t number = 0;
  std::size_t count = 0;
  std::string wanted;
  std::string line;
  if (!whole_line(in, line)) {
    return std::nullopt;
  }
  std::istringstream head(line);
  if (!(head >> number >> count >> wanted) || number != first || count == 0) {
    return std::nullopt;
  }
  std::string text;
  std::vector<SweepRow> rows;
  for (std::size_t i = 0; i < count && whole_line(in, line); ++i) {
    text += line + '\n';
    rows.push_back(row_of(line, cells));
  }
  return fmt::format("{:016x}", checksum(text)) == wanted ? std::optional(rows)
                                                          : std::nullopt;
}

}  // namespace trochoid::sweep
