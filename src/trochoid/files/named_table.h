#pragma once

#include <trochoid/files/csv_columns.h>

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// Tables in text whose columns are found by their names.
namespace trochoid::files {

/// A column that a reader looks for.
struct WantedColumn {
  NameList names;  ///< as `plain` makes them
  Quantity quantity = Quantity::number;
  std::string_view lacking;  ///< what no column is named; empty: it may be absent
};

/// Numbers in SI, below one another.
struct NamedTable {
  std::vector<std::vector<double>> columns;  ///< as wanted; empty: there is no such one
  std::vector<std::size_t> lines;            ///< of each row
  std::vector<base::Warning> notes;          ///< what had to be assumed
};

/// Where the columns stand under a head; none: there is no such one.
using FindColumns = std::function<std::vector<std::optional<TableColumn>>(
    const TableHead&, Problems&, std::vector<base::Warning>&)>;

/// @brief Read a table under a row of names, with or without a row of units.
/// @throws base::InputError with every problem of names, units and numbers
NamedTable read_named_table(TableText& table, const FindColumns& find);

/// @brief The same by usual names; of each column one at most may have them.
NamedTable read_named_table(TableText& table, std::span<const WantedColumn> wanted);

/// Of a column that must increase, for messages.
struct Increasing {
  std::string_view noun;  ///< `time`
  std::string_view unit;  ///< `s`
  double factor = 1.0;    ///< of that unit to SI
};

/// @brief Report every number that does not come after the one before.
void check_increasing(const std::vector<double>& values,
                      const std::vector<std::size_t>& lines, const Increasing& column,
                      Problems& problems);

}  // namespace trochoid::files
