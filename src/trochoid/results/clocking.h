#pragma once

#include <trochoid/results/identify.h>
#include <trochoid/results/value.h>

#include <string>

namespace trochoid::results {

/// @brief `clocking` of the summary.
/// @param factor  half of a 95 % interval over its standard error
Object clocking_value(const Clocking& clocking, double factor);

/// @brief The same for a person, below the table of fits.
std::string clocking_lines(const Clocking& clocking, double factor);

}  // namespace trochoid::results
