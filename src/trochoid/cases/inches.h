#pragma once

#include <trochoid/cases/document.h>

#include <string>
#include <string_view>

namespace trochoid::cases {

/// @brief The key of millimetres that a key of inches stands for, if a case has one.
///
/// `diameter_in` -> `diameter_mm`, `feed_rate_in_per_min` -> `feed_rate_mm_per_min`.
/// @return empty: it is no key of inches
std::string key_in_mm(std::string_view key);

/// @brief The key of inches that may stand for one of millimetres; empty: none may.
std::string key_in_inches(std::string_view key);

/// @brief `runout.radial_offsets_in[2]` -> `runout.radial_offsets_mm[2]`; what is in no
/// inches stays.
std::string path_in_mm(std::string_view path);

/// @brief A value in inches in millimetres; of a list each number but a count, of other
/// values none.
/// @param path  of its key, in inches
Node value_in_mm(std::string_view path, Node value);

/// @brief Keys of inches become those of millimetres, in a table and all below it.
///
/// But not below `sweep`, whose keys name what they set, nor where a table has both.
void take_inches(Node& table);

}  // namespace trochoid::cases
