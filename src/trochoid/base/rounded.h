#pragma once

#include <string>

namespace trochoid::base {

/// @brief A value rounded to its error: `2596 +- 57`, `0.2 +- 2.9`.
/// @param half  half width of its interval, rounded to two digits; not above 0: the
///              value alone, with five digits
std::string with_error(double value, double half);

/// @brief A value in as many digits as it is known to, and two more, for a file that is
/// read again: of what is known together better than alone, none may be lost.
/// @param error  half width of its interval, or its standard error; not above 0: all digits
std::string as_known(double value, double error);

/// @brief A part from 0 to 1 in percent; where it
/// is no such part, that it is not known.
std::string percent(double part);

}  // namespace trochoid::base
