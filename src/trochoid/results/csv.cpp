#include <trochoid/results/folder.h>
#include <trochoid/results/number.h>

#include <stdexcept>

namespace trochoid::results {

std::string csv(const base::Table& table) {
  const std::size_t rows =
      table.columns.empty() ? 0 : table.columns.front().values.size();
  std::string text;
  text.reserve((rows + 1) * table.columns.size() * 12);
  for (const auto& column : table.columns) {
    if (column.values.size() != rows) {
      throw std::invalid_argument(table.file + ": column " + column.name + " has " +
                                  std::to_string(column.values.size()) +
                                  " values, the first column " + std::to_string(rows));
    }
    if (&column != &table.columns.front()) text += ',';
    text += column.name;
  }
  text += '\n';
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (i > 0) text += ',';
      append_number(text, table.columns[i].values[row]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace trochoid::results
