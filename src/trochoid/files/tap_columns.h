#pragma once

#include <trochoid/files/csv.h>
#include <trochoid/files/frf_file.h>
#include <trochoid/files/frf_table.h>
#include <trochoid/files/numeric_table.h>
#include <trochoid/files/uff58.h>

#include <string>
#include <vector>

/// Records of hammer blows in time, from whatever file they stand in.
namespace trochoid::files {

/// One channel of a record in time.
struct TapColumn {
  std::string name;  ///< with its unit where the file keeps them together: `force_N`
  std::string unit;  ///< empty: none, or it is part of the name
  double sample_rate = 0.0;  ///< [Hz]; 0: not stated
  std::vector<double> values;
  std::size_t line = 1;  ///< for messages
  std::size_t at = 1;
};

/// @brief Whether columns of these names hold a force over time.
bool is_tap(const std::vector<std::string>& names);

/// @brief The columns of a table in text.
std::vector<TapColumn> tap_columns(const FrfTable& table);

/// @brief The columns of a binary file that a record of blows may need.
std::vector<TapColumn> tap_columns(const NumericTable& table);

/// @brief The records in time of a universal file: named by what their axes say.
std::vector<TapColumn> tap_columns(const UffFile& file);

/// @brief Force, response and sampling rate among columns, in SI.
///
/// Names begin with `time`, `force` or `hammer`, and `acceleration`, `acc`, `velocity`,
/// `displacement` or `response`; the unit follows (`acceleration_m/s2`, `acc_g`).
/// @param source  its dataset picks one of several responses
FrfFile tap_file(std::vector<TapColumn> columns, const FrfSource& source,
                 Problems& problems);

}  // namespace trochoid::files
