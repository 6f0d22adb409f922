#pragma once

#include <trochoid/files/record_source.h>

#include <filesystem>
#include <istream>
#include <string>

namespace trochoid::files {

/// @brief A record as a file with a name, which libraries of other formats ask for.
///
/// The file of the record where it has one; else the stream is written to a temporary
/// file, which goes with this object.
class DiskFile {
 public:
  /// @throws base::InputError  when no temporary file can be written
  DiskFile(std::istream& in, const std::string& name, const RecordSource& source);
  ~DiskFile();
  DiskFile(const DiskFile&) = delete;
  DiskFile& operator=(const DiskFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  bool temporary_ = false;
};

}  // namespace trochoid::files
