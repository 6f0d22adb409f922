#pragma once

#include <trochoid/base/table.h>
#include <trochoid/base/warning.h>
#include <trochoid/results/value.h>

#include <string>
#include <vector>

namespace trochoid::results {

/// @brief What every answer says besides its numbers.
struct Heading {
  std::string title;    ///< of the case
  bool ok = true;       ///< false: no good answer exists (exit code 1)
  std::string message;  ///< one sentence; when not ok, the reason
  std::vector<base::Warning> warnings;
  std::string case_toml;  ///< the case as understood, every default filled in
};

/// @brief An answer as text and tables, in the units of files: the whole content of a
/// result folder, and all that the report may show.
struct Answer {
  std::string command;  ///< for example `simulate`
  Heading heading;
  Value result;             ///< the object `result` of summary.json
  std::string short_table;  ///< what the program prints for a person
  std::vector<base::Table> tables;
  std::vector<base::TextFile> texts;  ///< beside case.toml, for example what others
                                      ///< include
};

/// @brief What the page says as the terminal does, and what it does not decide again: made
/// from the numbers of a summary, which may have been read from a folder.
Object words_of(const Answer& answer);

}  // namespace trochoid::results
