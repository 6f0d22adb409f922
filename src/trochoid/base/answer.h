#pragma once

#include <string>
#include <vector>

namespace trochoid::base {

/// Something the user should know about an answer that stands all the same.
struct Warning {
  std::string code;     ///< short and stable, for programs: `idle_tooth`
  std::string message;  ///< a sentence, for people
};

/// One CSV file of an answer. The unit is part of every column name.
struct Table {
  struct Column {
    std::string name;            ///< for example `Fx_N`
    std::vector<double> values;  ///< in the unit of the name; all columns equally long
  };
  std::string file;  ///< for example `forces.csv`
  std::vector<Column> columns;
};

/// A further text file of an answer.
struct TextFile {
  std::string file;  ///< for example `material.toml`
  std::string text;
};

/// @brief What a command answers, in the units of its files: the whole content of its
/// result folder, and all that the report may show.
struct Answer {
  std::string command;  ///< for example `simulate`
  std::string title;    ///< of the case
  bool ok = true;       ///< false: no good answer exists (exit code 1)
  std::string message;  ///< one sentence; when not ok, the reason
  std::vector<Warning> warnings;
  std::string result;       ///< JSON text of the object `result` of summary.json
  std::string short_table;  ///< what the program prints for a person
  std::string case_toml;    ///< the case as understood, every default filled in
  std::vector<Table> tables;
  std::vector<TextFile> texts;  ///< beside case.toml, for example what others include
};

}  // namespace trochoid::base
