#pragma once

#include <trochoid/base/table.h>
#include <trochoid/results/fields.h>

#include <concepts>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

/// Columns of CSV files, described as the keys of fields.h are.
namespace trochoid::results {

/// A number of a column, in SI.
struct ColumnValue {
  double value = 0.0;
  Content::Numbers kind = Content::Numbers::computed;

  template <class Number>
  requires std::is_arithmetic_v<Number> ColumnValue(Number number)
      : value(static_cast<double>(number)) {}
  ColumnValue(Given one) : value(one.value), kind(Content::Numbers::given) {}
  ColumnValue(AsNamed one) : value(one.value), kind(Content::Numbers::as_named) {}
};

/// @brief A column of a table, of numbers or of texts, which is made of a T; or several that differ in a word of
/// their names.
template <class T>
struct Column {
  using Names = std::function<std::vector<std::string>(const T&)>;
  std::string_view name;  ///< of several with `*` for what differs
  std::string_view meaning;
  std::function<ColumnValue(const T&, std::size_t row, std::size_t which)> cell;
  If<T> there;   ///< empty: always
  Names differ;  ///< what stands for `*`; empty: a single column
  std::function<std::string(const T&, std::size_t row)> text;  ///< in place of `cell`

  template <class Get>
  requires std::invocable<Get, const T&, std::size_t> Column(std::string_view title,
                                                             std::string_view what,
                                                             Get get, If<T> when = {})
      : name(title), meaning(what), there(std::move(when)) {
    if constexpr (std::is_convertible_v<
                      std::invoke_result_t<Get, const T&, std::size_t>,
                      std::string_view>) {
      text = [get](const T& of, std::size_t row) { return std::string(get(of, row)); };
    } else {
      cell = [get](const T& of, std::size_t row, std::size_t) -> ColumnValue {
        return get(of, row);
      };
    }
  }

  template <class Get>
  requires std::invocable<Get, const T&, std::size_t, std::size_t> Column(
      std::string_view title, std::string_view what, Names names, Get get)
      : name(title), meaning(what), cell(get), differ(std::move(names)) {}
};

/// A number of a column in the unit of its name.
double cell_in_unit(double unit, ColumnValue cell);

/// What one of the unit of a column is in SI.
double unit_of_column(std::string_view name);

/// A column as the page of formats has it.
struct ColumnText {
  std::string_view file;
  std::string name;
  std::string_view meaning;
};

/// @brief A CSV file that is made of a T.
template <class T>
class Columns {
 public:
  Columns(std::string_view file, std::function<std::size_t(const T&)> rows,
          std::vector<Column<T>> all)
      : file_(file), rows_(std::move(rows)), all_(std::move(all)) {}

  [[nodiscard]] base::Table table(const T& of) const {
    base::Table table{std::string(file_), {}};
    const std::size_t rows = rows_(of);
    for (const Column<T>& column : all_) {
      if (column.there && !column.there(of)) continue;
      if (column.text) {
        base::Table::Column& texts = table.columns.emplace_back();
        texts.name = column.name;
        for (std::size_t row = 0; row < rows; ++row) {
          texts.texts.push_back(column.text(of, row));
        }
        continue;
      }
      const auto names =
          column.differ ? column.differ(of) : std::vector<std::string>(1);
      for (std::size_t which = 0; which < names.size(); ++which) {
        std::string name(column.name);
        if (column.differ) name.replace(name.find('*'), 1, names[which]);
        const double unit = unit_of_column(name);
        base::add_column(table, name, rows, [&](std::size_t row) {
          return cell_in_unit(unit, column.cell(of, row, which));
        });
      }
    }
    return table;
  }

  void add_texts(std::vector<ColumnText>& out) const {
    for (const Column<T>& column : all_) {
      out.push_back({file_, std::string(column.name), column.meaning});
    }
  }

 private:
  std::string_view file_;
  std::function<std::size_t(const T&)> rows_;
  std::vector<Column<T>> all_;
};

}  // namespace trochoid::results
