#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

/// Channels of one record that a file says began at different times.
namespace trochoid::files {

/// A column and where it begins.
struct StartedColumn {
  std::string name;    ///< for messages
  double start = 0.0;  ///< of its first sample [s]
  std::vector<double>* values = nullptr;
};

/// What was done about the starts.
struct Starts {
  double first = 0.0;   ///< common first time of all columns [s]
  std::string problem;  ///< why they cannot be brought together; empty: they can
  std::string note;     ///< what was done; empty: nothing
};

/// @brief Bring columns that begin at different times to the times that all of them have.
///
/// @eq S-9  y(n) = sum_j x(j) w(n + s - j)/sum_j w(n + s - j),  w(u) = sinc(u) sinc(u/8)
/// @src derived
///
/// Whole steps are cut off; by parts of a step the samples are interpolated, which leaves
/// out eight of them at both ends of all columns.
/// @param rate  samples a second [Hz]
Starts align_starts(std::span<StartedColumn> columns, double rate);

}  // namespace trochoid::files
