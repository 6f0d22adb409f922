#pragma once

#include <trochoid/base/texts.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace trochoid::base {

/// One CSV file of an answer, numbers but for few columns. The unit is part of every column name.
struct Table {
  struct Column {
    std::string name;            ///< for example `Fx_N`
    std::vector<double> values;  ///< in the unit of the name; all columns equally long
    Texts texts = {};            ///< of a column of texts, in place of numbers
  };
  std::string file;  ///< for example `forces.csv`
  std::vector<Column> columns;
};

/// How many rows a column has.
inline std::size_t rows_of(const Table::Column& column) noexcept {
  return column.texts.empty() ? column.values.size() : column.texts.size();
}

/// @brief Append a column.
/// @param value  of each row, called with 0, 1 ... rows - 1
template <class Value>
void add_column(Table& table, std::string name, std::size_t rows, const Value& value) {
  Table::Column& column = table.columns.emplace_back();
  column.name = std::move(name);
  column.values.reserve(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    column.values.push_back(static_cast<double>(value(i)));
  }
}

/// A further text file of an answer.
struct TextFile {
  std::string file;  ///< for example `material.toml`
  std::string text;
  bool named_by_user = false;  ///< its name is in no list of ours
};

}  // namespace trochoid::base
