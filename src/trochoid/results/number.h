#pragma once

#include <string>

namespace trochoid::results {

/// @brief Append the shortest text that reads back to the same double.
///
/// Nothing is appended for NaN and the infinities: no file of ours holds them.
/// @return false when nothing was appended
bool append_number(std::string& text, double value);

}  // namespace trochoid::results
