#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/files/record_source.h>
#include <trochoid/signal/record.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

/// Force records that are columns of binary numbers: what their readers have in common.
namespace trochoid::files {

/// What a file says of one column of numbers before they are read.
struct NumericColumn {
  std::string name;          ///< the last part of its path
  std::string path;          ///< in the file, `group/name`; empty: the name alone
  std::string unit;          ///< empty: none, or it is part of the name
  std::size_t count = 0;     ///< samples
  double sample_rate = 0.0;  ///< [Hz]; 0: not stated
  double first_time = 0.0;   ///< of the first sample [s]
  std::string matrix = {};   ///< path of the matrix that it is a column of
  std::size_t width = 1;     ///< columns of that matrix
  std::size_t place = 0;     ///< of this one among them, from 0
};

/// The columns of a file; only those that a record needs are read.
struct NumericTable {
  std::vector<NumericColumn> columns;
  /// All samples of a column, as they stand in the file.
  std::function<std::vector<double>(std::size_t)> values;
  std::vector<base::Warning> notes;  ///< what the reader had to assume
};

/// No more bytes than this are taken out of a file, packed or not.
inline constexpr double largest_record = 2e9;

/// @brief Refuse a file for one reason.
/// @throws base::InputError  `name: why`
[[noreturn]] void refuse(const std::string& name, const std::string& why);

/// @brief Find forces, time and angle among the columns by the rules of text, read them
/// and bring them to SI.
///
/// A name that several columns have stands for none of them: their paths do.
/// @param name  of the file, for messages
/// @throws base::InputError with every problem
signal::Record record_of(const NumericTable& table, const std::string& name,
                         const RecordSource& source);

}  // namespace trochoid::files
