#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/files/csv_table.h>

#include <functional>
#include <span>

/// Columns of a table, found by their names, and their units.
namespace trochoid::files {

enum class Quantity {
  force,
  moment,
  power,
  time,
  angle,
  length,
  number,  ///< a plain number: it has no unit
  other,
};

/// @brief Whether a row below the names holds units: texts, and no number at all.
bool is_unit_row(std::span<const Field> row);

/// @brief Whether a text is a unit, of whatever quantity, perhaps in brackets.
bool is_unit(std::string_view text);

/// @brief A name as it is compared: small letters, no blanks, `_` or `-`.
std::string plain(std::string_view text);

using NameList = std::span<const std::string_view>;

/// One search through a head.
struct ColumnSearch {
  const TableHead& head;
  Problems& problems;
  std::vector<base::Warning>& notes;            ///< what had to be assumed
  std::function<bool(std::string_view)> known;  ///< a `plain` name without its unit
  std::string_view advice;                      ///< where several columns would do
  double length_unit = 0.0;  ///< to SI, of lengths that name none; 0: they must
  std::string_view without_names = {};  ///< what else helps where there are no names
};

/// @brief A name of a column without its unit, as `plain` makes it.
std::string base_name(const ColumnSearch& search, std::string_view text);

/// @brief All names of the head, for a message.
std::string all_names(const TableHead& head);

/// @brief Report a head of numbers: its row of names is missing.
bool lacks_names(const ColumnSearch& search, std::string_view example);

/// @brief Index of the only column that passes; several are a problem.
std::optional<std::size_t> only_column(
    const ColumnSearch& search, const std::function<bool(std::string_view)>& passes,
    std::string_view wanted);

/// @brief Index of the only column with one of these names, unit apart.
std::optional<std::size_t> usual_column(const ColumnSearch& search, NameList names);

/// @brief A column with its unit, which is part of the name (`Fx_N`, `Fx [kN]`,
/// `Fy (N)`, `Fz / N`) or stands in the row of units.
///
/// Forces and times without a unit are taken in N and s, with a note; angles and
/// lengths without a unit are refused.
TableColumn column_at(const ColumnSearch& search, std::size_t index, Quantity quantity);

}  // namespace trochoid::files
