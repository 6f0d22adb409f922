#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/cases/document.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace trochoid::cases {

/// @brief What reading a case file found: where each key stands and what is wrong.
///
/// Keys are named by their path: `tool.teeth`, `measurement[1].cut.spindle_rpm`.
struct Findings {
  struct Problem {
    Location where;
    std::string text;
  };
  std::string file;                 ///< the case file itself
  int first_line = 1;               ///< 0: no file, as in Location
  std::filesystem::path base = {};  ///< as in CaseSource
  std::map<std::string, Location> places;
  std::set<std::string> wrong;  ///< paths with a problem of their own
  std::vector<Problem> problems;
  std::vector<base::Warning> notes;  ///< accepted, but hardly meant
};

/// @brief Add a problem and remember that the key cannot be relied upon.
void report(Findings& findings, const std::string& path, const Location& where,
            std::string text);

/// @brief The same, where the key stands; or its table; or the start of the file.
void report(Findings& findings, const std::string& path, std::string text);

/// @brief Whether none of these keys, nor a table that holds one, has a problem.
bool sound(const Findings& findings, std::initializer_list<std::string> paths);

/// @brief Where a key or the nearest table around it stands.
Location place_of(const Findings& findings, const std::string& path);

/// @brief Every problem as a line, in the order of file, line and column.
std::vector<std::string> lines(const Findings& findings);

/// @brief The name most like a misspelt one; empty when none is near.
std::string nearest(std::string_view wrong, const std::vector<std::string>& names);

/// @brief `; did you mean "x"?`, or which names there are when none is near.
std::string suggestion(std::string_view wrong, const std::vector<std::string>& names);

/// @brief A key as a message shows it: quoted when it is no plain word, never long.
std::string shown_key(std::string_view key);

}  // namespace trochoid::cases
