#pragma once

#include <trochoid/cases/document.h>
#include <trochoid/cases/findings.h>
#include <trochoid/cases/schema.h>

#include <functional>
#include <string>

namespace trochoid::cases {

/// What the reading of a table depends on besides the table.
struct Reading {
  bool cutting_needed = true;        ///< so does Need::cutting
  bool coefficients_needed = false;  ///< Need::coefficient counts
  const Node* cut = nullptr;         ///< [cut], which a measurement may override
  bool only_own = false;             ///< inherited values have been judged before
};

/// @brief Read a table into the fields that `describe` shows, and report what is wrong.
/// @param path      `tool`, `measurement[1]`; empty for the top of the file
/// @param describe  calls a visitor with each key of the table
void read_table(const Node& table, const std::string& path,
                const std::function<void(const Visitor&)>& describe,
                const Reading& reading, Findings& findings);

/// @brief `; spindle_rpm belongs to [cut]`; empty for a key of no table.
std::string home_of(std::string_view key);

}  // namespace trochoid::cases
