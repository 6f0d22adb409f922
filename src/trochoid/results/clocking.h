#pragma once

#include <trochoid/results/fields.h>
#include <trochoid/results/identify.h>

#include <string>

namespace trochoid::results {

/// What `clocking` of the summary is made of.
struct Clocked {
  const Clocking& clocking;
  double factor = 0.0;  ///< half of a 95 % interval over its standard error
};

const Fields<Clocked>& clocking_fields();

/// @brief The same for a person, below the table of fits.
std::string clocking_lines(const Clocking& clocking, double factor);

}  // namespace trochoid::results
