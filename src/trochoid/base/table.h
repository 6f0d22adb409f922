#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace trochoid::base {

/// @brief A long list of texts of which few are different: each of these is kept once.
class Texts {
 public:
  Texts() = default;
  Texts(std::initializer_list<std::string> texts) {
    for (const std::string& text : texts) push_back(text);
  }

  void push_back(const std::string& text) {
    const auto fresh = static_cast<std::uint32_t>(words_.size());
    const auto [known, added] = numbers_.try_emplace(text, fresh);
    if (added) words_.push_back(text);
    list_.push_back(known->second);
  }

  [[nodiscard]] bool empty() const noexcept { return list_.empty(); }
  [[nodiscard]] std::size_t size() const noexcept { return list_.size(); }
  const std::string& operator[](std::size_t i) const { return words_[list_[i]]; }

  /// The different ones.
  [[nodiscard]] const std::vector<std::string>& words() const noexcept {
    return words_;
  }

  /// Forget those behind the first ones.
  void cut(std::size_t size) {
    if (size < list_.size()) list_.resize(size);
  }

 private:
  std::vector<std::uint32_t> list_;
  std::vector<std::string> words_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
};

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
