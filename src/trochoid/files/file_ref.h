#pragma once

#include <memory>
#include <string>

namespace trochoid::files {

struct NumericTable;

/// Measured data that a case names: in a file, or in memory under the name of one.
struct FileRef {
  std::string name;      ///< as the case has it; empty: none is named
  std::string path;      ///< absolute, or relative to where we run; in memory the name
  std::string location;  ///< file:line:col of the name in a case; empty: none
  std::shared_ptr<const std::string> bytes = {};     ///< what the file would hold
  std::shared_ptr<const NumericTable> numbers = {};  ///< the columns of a record

  [[nodiscard]] bool in_memory() const noexcept { return bytes || numbers; }
};

/// @brief A file that no case names.
inline FileRef file_at(const std::string& path) {
  return {.name = path, .path = path, .location = {}};
}

}  // namespace trochoid::files
