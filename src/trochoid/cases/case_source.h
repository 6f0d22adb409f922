#pragma once

#include <trochoid/cases/case.h>
#include <trochoid/cases/document.h>
#include <trochoid/files/numeric_table.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

/// Cases that are in no file, or not as a whole.
namespace trochoid::cases {

/// Measured data in memory, by the names that a case has in `file`.
struct DataInMemory {
  std::map<std::string, std::shared_ptr<const files::NumericTable>> records;
  /// Responses, steps and walls: what their files would hold.
  std::map<std::string, std::shared_ptr<const std::string>> texts;
};

/// @brief What a case file would say, from wherever it comes.
struct CaseSource {
  const Node& root;            ///< with what it includes
  std::filesystem::path file;  ///< its folder is what names of files count from
  DataInMemory data;
  /// What relative names of case files count from, where that is not the folder in which
  /// the process runs: names of files are found from anywhere.
  std::filesystem::path base = {};
  /// Of a program only the tool is asked for: [tool], [runout], [force].
  bool tool_only = false;
  /// Whether Case::as_understood is wanted.
  bool echo = true;
};

/// @brief As read_case of a file.
Case read_case(const CaseSource& source, std::optional<Command> command,
               const std::filesystem::path& result_folder = {});

/// @brief The command that the tables of a case ask for: `check` looks for what it needs, and
/// `trochoid CASE.toml` runs it.
Command command_of(const Node& root);

/// @brief Check the keys that are there, whatever they are meant for; what a command
/// needs may still be missing.
/// @throws base::InputError with every problem
void check_keys(const CaseSource& source);

}  // namespace trochoid::cases
