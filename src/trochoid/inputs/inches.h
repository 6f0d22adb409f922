#pragma once

#include <trochoid/inputs/document.h>

#include <string>
#include <string_view>

namespace trochoid::inputs {

/// @brief The key of millimetres that a key of inches stands for.
///
/// `diameter_in` -> `diameter_mm`, `feed_rate_in_per_min` -> `feed_rate_mm_per_min`.
/// @return empty: it is no key of inches
std::string key_in_mm(std::string_view key);

/// @brief The key of inches that may stand for one of millimetres; empty: none may.
std::string key_in_inches(std::string_view key);

/// @brief A value in inches in millimetres; of a list each number, of other values none.
Node value_in_mm(Node value);

/// @brief Keys of inches become those of millimetres, in a table and all below it.
///
/// But not below `sweep`, whose keys name what they set.
/// @throws base::InputError where a table has both
void take_inches(Node& table);

}  // namespace trochoid::inputs
