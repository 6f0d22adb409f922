#pragma once

#include <trochoid/files/csv.h>
#include <trochoid/files/frf_file.h>

#include <cstddef>
#include <string>
#include <vector>

namespace trochoid::files {

/// A unit as a file has it, perhaps empty, and where.
struct UnitText {
  std::string text;
  std::size_t line = 1;
  std::size_t column = 1;
};

/// @brief Kind and factor to SI from what the file and the user say.
///
/// The kind goes to `out`, and a note where the unit had to be assumed; what is wrong
/// goes to the problems.
double settle_unit(const UnitText& unit, const FrfSource& source, FrfFile& out,
                   Problems& problems);

/// @brief Frequencies must increase from 0 or above.
/// @param omega  [rad/s]
/// @param lines  of the file on which they stand; one: all on it
/// @param at     column of the file
void check_order(const std::vector<double>& omega,
                 const std::vector<std::size_t>& lines, std::size_t at,
                 Problems& problems);

}  // namespace trochoid::files
