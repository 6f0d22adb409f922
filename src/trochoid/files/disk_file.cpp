#include <trochoid/files/disk_file.h>

#include <trochoid/files/numeric_table.h>

#include <fstream>
#include <system_error>

#include <stdlib.h>
#include <unistd.h>

namespace trochoid::files {

DiskFile::DiskFile(std::istream& in, const std::string& name,
                   const RecordSource& source)
    : path_(source.file.path) {
  if (!path_.empty()) return;
  std::error_code error;
  std::string made = (std::filesystem::temp_directory_path(error) / "trochoid-XXXXXX");
  const int descriptor = mkstemp(made.data());
  if (descriptor < 0) refuse(name, "no temporary file can be made to read it from");
  close(descriptor);
  path_ = made;
  temporary_ = true;
  std::ofstream out(path_, std::ios::binary);
  in.clear();
  in.seekg(0);
  out << in.rdbuf();
}

DiskFile::~DiskFile() {
  std::error_code error;
  if (temporary_) std::filesystem::remove(path_, error);
}

}  // namespace trochoid::files
