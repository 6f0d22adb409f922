#pragma once

#include <trochoid/results/answer.h>
#include <trochoid/results/json.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// Parts of an answer, by their names.
namespace trochoid::results::test {

inline const base::Table& table_of(const Answer& answer, std::string_view file) {
  const auto at = std::find_if(answer.tables.begin(), answer.tables.end(),
                               [&](const base::Table& t) { return t.file == file; });
  if (at == answer.tables.end()) {
    throw std::out_of_range("no table " + std::string(file));
  }
  return *at;
}

inline const std::vector<double>& column_of(const base::Table& table,
                                            std::string_view name) {
  const auto at =
      std::find_if(table.columns.begin(), table.columns.end(),
                   [&](const base::Table::Column& c) { return c.name == name; });
  if (at == table.columns.end()) {
    throw std::out_of_range("no column " + std::string(name));
  }
  return at->values;
}

inline std::vector<std::string> columns_of(const base::Table& table) {
  std::vector<std::string> names;
  for (const base::Table::Column& column : table.columns) {
    names.push_back(column.name);
  }
  return names;
}

/// The JSON of the value at keys one below the other; empty: there is none.
template <class... Keys>
std::string json_at(const Answer& answer, Keys... keys) {
  const Value* value = &answer.result;
  for (const std::string_view key : {std::string_view(keys)...}) {
    value = value == nullptr ? nullptr : find(*value, key);
  }
  return value == nullptr ? std::string() : json_text(*value);
}

}  // namespace trochoid::results::test
