#pragma once

#include <string>
#include <string_view>

namespace trochoid::cases {

/// @brief Shortest text that reads back to the same double.
std::string number_text(double value);

/// @brief Shortest number of a file that reads back to the same SI value.
/// @param si    the value [SI]
/// @param unit  factor from the file's unit to SI
std::string number_text(double si, double unit);

/// @brief A length in mm.
std::string mm(double length);

/// @brief The SI value of the file number nearest to an SI value.
///
/// A computed default passes through this, so that writing it to a file and reading it
/// again changes no bit.
double as_written(double si, double unit);

/// @brief Text as a TOML string: quoted, with escapes where TOML wants them.
std::string toml_string(std::string_view text);

}  // namespace trochoid::cases
