#include <trochoid/files/hdf5_record.h>

namespace trochoid::files {

bool is_hdf5(std::string_view head) {
  constexpr std::string_view signature = "\x89HDF\r\n\x1A\n";
  for (const std::size_t at : {0U, 512U, 1024U, 2048U}) {
    if (head.size() > at && head.substr(at).starts_with(signature)) return true;
  }
  return false;
}

signal::Record read_hdf5_record(std::istream& in, const std::string& name,
                                const RecordSource& source) {
  return read_hdf5_columns(in, name, source, Hdf5Kind::plain);
}

}  // namespace trochoid::files
