#pragma once

#include <trochoid/files/csv.h>
#include <trochoid/signal/record.h>

#include <span>
#include <string>

/// The time column of a record.
namespace trochoid::files {

/// How exactly times are printed.
struct PrintedTime {
  bool six_digits = false;  ///< by DynoWare
  double step = 0.0;        ///< of the last decimal that occurs [s]; 0: unknown
};

/// Times as printed [s], and the line of each.
struct TimeColumn {
  std::span<const double> values;
  std::span<const std::size_t> lines;  ///< empty: the file has none
  std::size_t column = 1;
  PrintedTime printed;
};

/// Who knows the sampling rate [Hz]; 0: does not say.
struct SampleRates {
  double given = 0.0;           ///< by the case file
  double stated = 0.0;          ///< by the record
  std::size_t stated_line = 0;  ///< 0: the file has no lines
  double first_time = 0.0;      ///< of the first sample, where there is no time [s]
};

/// @brief Give a record with its forces and, where there are any, angles and times its
/// sampling rate, and times that follow it.
/// @param time  the times of the record as they were read
void settle_time(signal::Record& record, const TimeColumn& time,
                 const SampleRates& rates, Problems& problems);

/// @brief Refuse times that do not increase, where no sampling rate replaces them.
void check_increasing(const TimeColumn& time, Problems& problems);

/// @brief Refuse times that contradict a sampling rate: rows are missing or doubled, or
/// the rate is wrong. Coarse printing is allowed for.
/// @param rate  [Hz]
void check_rate(const TimeColumn& time, double rate, Problems& problems);

/// @brief What to say of steps much longer than the usual one; empty: there are none.
/// @param time  increasing [s]
std::string gap_note(std::span<const double> time);

/// @brief Sampling rate of evenly spaced times; 0: they are not even.
/// @return [Hz]
double even_rate(std::span<const double> time);

/// @brief The last decimal place of a printed number; 1 without decimals.
double last_decimal(std::string_view text);

}  // namespace trochoid::files
