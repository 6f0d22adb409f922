#include <trochoid/results/csv_cells.h>

#include <algorithm>

namespace trochoid::results {

void append_quoted(std::string& line, std::string_view text) {
  line += '"';
  for (const char c : text) {
    line += c == '\n' || c == '\r' ? ' ' : c;
    if (c == '"') line += '"';
  }
  line += '"';
}

std::string_view cut_cell(std::string_view& row) noexcept {
  bool quoted = false;
  std::size_t end = 0;
  while (end < row.size() && (quoted || row[end] != ',')) {
    if (row[end] == '"') quoted = !quoted;
    ++end;
  }
  const std::string_view cell = row.substr(0, end);
  row.remove_prefix(std::min(end + 1, row.size()));
  return cell;
}

std::string unquoted(std::string_view cell) {
  std::string text;
  for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
    text += cell[i];
    if (cell[i] == '"') ++i;
  }
  return text;
}

}  // namespace trochoid::results
