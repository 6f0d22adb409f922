#include <trochoid/results/csv_cells.h>
#include <trochoid/results/folder.h>
#include <trochoid/results/number.h>

#include <ostream>
#include <sstream>
#include <stdexcept>

namespace trochoid::results {

namespace {

/// Text is handed on in pieces about as long.
constexpr std::size_t block = std::size_t{1} << 18;

std::size_t rows_of(const base::Table& table) {
  const std::size_t rows = table.columns.empty() ? 0 : rows_of(table.columns.front());
  for (const auto& column : table.columns) {
    if (rows_of(column) != rows) {
      throw std::invalid_argument(table.file + ": column " + column.name + " has " +
                                  std::to_string(rows_of(column)) +
                                  " values, the first column " + std::to_string(rows));
    }
  }
  return rows;
}

}  // namespace

void write_csv(std::ostream& out, const base::Table& table) {
  const std::size_t rows = rows_of(table);
  std::string text;
  const auto hand_on = [&] {
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    text.clear();
  };
  for (const auto& column : table.columns) {
    if (&column != &table.columns.front()) text += ',';
    text += column.name;
  }
  text += '\n';
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (i > 0) text += ',';
      const auto& column = table.columns[i];
      if (column.texts.empty()) {
        append_number(text, column.values[row]);
      } else {
        append_quoted(text, column.texts[row]);
      }
    }
    text += '\n';
    if (text.size() >= block) hand_on();
  }
  hand_on();
}

std::string csv(const base::Table& table) {
  std::ostringstream out;
  write_csv(out, table);
  return std::move(out).str();
}

}  // namespace trochoid::results
