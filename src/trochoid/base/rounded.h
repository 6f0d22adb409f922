#pragma once

#include <string>

namespace trochoid::base {

/// @brief A value rounded to its error: `2596 +- 57`, `0.2 +- 2.9`.
/// @param half  half width of its interval, rounded to two digits; not above 0: the
///              value alone, with five digits
std::string with_error(double value, double half);

/// @brief A part from 0 to 1 in percent; where it
/// is no such part, that it is not known.
std::string percent(double part);

}  // namespace trochoid::base
